// What is marked over the picture: outlines of the parts of shapes that are seen.

import type { Seen } from "./seen.ts";

export interface Marked {
  /** The shape that is picked, those alike, those lit from elsewhere, and the one under the pointer; -1: none. */
  picked: number;
  alike: ReadonlySet<number>;
  lit: ReadonlySet<number>;
  hovered: number;
  /** Whether the shapes together, which are one wall of a building, have an outline. */
  framed?: boolean;
}

type Colour = [red: number, green: number, blue: number, alpha: number];
const COLOURS: Record<"picked" | "alike" | "lit" | "hovered" | "tint", Colour> = {
  picked: [20, 118, 230, 255],
  alike: [20, 118, 230, 150],
  lit: [232, 120, 10, 230],
  hovered: [255, 255, 255, 235],
  tint: [20, 118, 230, 44],
};
const SHADE: Colour = [10, 30, 60, 150]; // beside a bright line, so that it is seen on bright walls

export const isMarked = ({ picked, alike, lit, hovered, framed }: Marked): boolean =>
  !!framed || picked >= 0 || hovered >= 0 || alike.size > 0 || lit.size > 0;

/** Draw them; `wide`: pixels of a line. */
export function drawMarks(seen: Seen, shapes: Int32Array, marked: Marked, to: ImageData, wide: number): void {
  const { width, height, triangle } = seen;
  const out = new Uint32Array(to.data.buffer);
  out.fill(0);
  if (!isMarked(marked)) return;
  const count = shapes.reduce((most, shape) => Math.max(most, shape), 0) + 1;
  // 0: not marked; the greatest goes over the others.
  const ranks = new Uint8Array(count);
  for (const shape of marked.lit) ranks[shape] = 1;
  for (const shape of marked.alike) ranks[shape] = 2;
  if (marked.picked >= 0) ranks[marked.picked] = 3;
  const own = new Int32Array(width * height);
  for (let k = 0; k < own.length; k += 1)
    own[k] = (triangle[k] as number) < 0 ? -1 : (shapes[triangle[k] as number] as number);
  const colours = [[0, 0, 0, 0] as Colour, COLOURS.lit, COLOURS.alike, COLOURS.picked].map(packed);
  const [tint, bright, shade] = [COLOURS.tint, COLOURS.hovered, SHADE].map(packed) as [number, number, number];
  const at = (x: number, y: number) =>
    x < 0 || y < 0 || x >= width || y >= height ? -2 : (own[y * width + x] as number);
  for (let y = 0; y < height; y += 1)
    for (let x = 0; x < width; x += 1) {
      const k = y * width + x;
      const shape = own[k] as number;
      const rank = shape < 0 ? 0 : (ranks[shape] as number);
      const hover = shape >= 0 && shape === marked.hovered;
      if (marked.framed && shape >= 0 && rank < 2 && !hover) {
        const far = 3 * wide;
        if (at(x - far, y) < 0 || at(x + far, y) < 0 || at(x, y - far) < 0 || at(x, y + far) < 0)
          out[k] = colours[3] as number;
      }
      if (!rank && !hover) continue;
      const edge = (far: number) =>
        at(x - far, y) !== shape || at(x + far, y) !== shape || at(x, y - far) !== shape || at(x, y + far) !== shape;
      if (hover && rank < 3) out[k] = edge(wide) ? bright : edge(2 * wide) ? shade : 0;
      else if (edge(rank === 3 ? 2 * wide : wide)) out[k] = colours[rank] as number;
      else if (rank === 3) out[k] = tint;
    }
}

function packed([r, g, b, a]: Colour): number {
  const bytes = new Uint8Array([r, g, b, a]);
  return new Uint32Array(bytes.buffer)[0] as number;
}
