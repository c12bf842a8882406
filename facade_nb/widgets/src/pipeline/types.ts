// What passes and images are, as facade_nb/render/pipeline/passes.py has them.

export type Pixels = [width: number, height: number];
/** One number, some, or a matrix row by row (16). */
export type Value = number | readonly number[] | Float64Array;
export type Values = Record<string, Value>;

export interface Buffer {
  name: string;
  channels: number;
  kind: "f1" | "f2" | "f4" | "i4" | "depth";
  tells: string;
  side: number;
  part: number;
}

export interface Pass {
  name: string;
  vertex: string;
  fragment: string;
  reads: string[];
  writes: string[];
  draws: "mesh" | "screen";
  through: string;
  /** Whether it draws what turns to whoever looks, or all else of the mesh. */
  turning?: boolean;
  /** It draws over what is there; nothing is cleared. */
  adds?: boolean;
  /** Whether what it draws is summed up with what there is, whatever lies in front. */
  sums?: boolean;
  /** Depths that say in which pixels there is something: only these are drawn, all others are cleared. */
  seen?: string;
  /** It draws the other pixels. */
  sky?: boolean;
  /** Whether a triangle is drawn from behind, too. */
  both?: boolean;
  when: string;
  tells: string;
}

/** A texture that shaders read, under the name of their sampler. */
export interface Image {
  size: Pixels;
  channels: number;
  kind: "f1" | "f2" | "f4";
}
