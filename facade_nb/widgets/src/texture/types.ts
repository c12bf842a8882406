// What facade_nb/widgets/texture/packet.py packs.

export type Pair = [number, number];
export type Triple = [number, number, number];

export interface TablePixel {
  at: Pair;
  channels: [label: string, value: string][];
}
export interface TableRule {
  name: string;
  operator: string;
  pixels: TablePixel[];
}

/** A grammar: its texture to the bit, and the shader that is large enough for it. */
export interface Scene {
  width: number;
  height: number;
  bits: 16 | 32;
  texture: Uint8Array;
  start: Pair;
  fragment: string;
  /** As `fragment` and the light together, with more samples at boundaries. */
  smooth: string;
  report: string;
  table: TableRule[];
}

export interface Tiles {
  width: number;
  height: number;
  pixels: Uint8Array;
  levels: number;
  count: number;
  table: Float32Array;
}

export type Light = Record<string, number | number[]>;

/** What is the same for all grammars. */
export interface Common {
  vertex: string;
  lit: string;
  plain: string;
  hours: Light[];
  side: number;
  noise: Float32Array;
}

export interface Step {
  rule: string;
  operator: string;
  text: string;
  scope: [number, number, number, number];
  /** The scope's corners and the pixel's place in space, metres: z is out of the façade, rooms lie below 0. */
  corners: Triple[];
  spot: Triple;
  faces: string[];
  layers: Pair[];
  seeds: Pair[];
  records: Pair[];
  color: number[] | null;
}
