// Where rectangles line up: edges of others, and of the façade.

import type { Drawn, Rect } from "./types.ts";

export type Side = 0 | 1 | 2 | 3;
/** The sides of a rectangle across and up. */
export const SIDES: readonly (readonly [low: Side, high: Side])[] = [
  [0, 2],
  [1, 3],
];

/** Places of edges along an axis (0 across, 1 up), of all openings but some, and of the façade. */
export function edges(drawn: Drawn, axis: 0 | 1, without: number): number[] {
  const sides = SIDES[axis] as readonly [Side, Side];
  const found = drawn.openings.flatMap(({ rect }, k) => (k === without ? [] : [rect[sides[0]], rect[sides[1]]]));
  return [...found, 0, axis === 0 ? drawn.width : drawn.height];
}

/** The least shift within reach that brings one of some places to an edge; null where there is none. */
export function nearest(places: readonly number[], lines: readonly number[], reach: number): number | null {
  let best: number | null = null;
  for (const place of places)
    for (const line of lines) {
      const shift = line - place;
      if (Math.abs(shift) <= reach && (best === null || Math.abs(shift) < Math.abs(best))) best = shift;
    }
  return best;
}

/** The least shift in a direction that brings one of some places to an edge; 0 where there is none. */
export function next(places: readonly number[], lines: readonly number[], direction: 1 | -1): number {
  let best = Number.POSITIVE_INFINITY;
  for (const place of places)
    for (const line of lines) {
      const ahead = direction * (line - place);
      if (ahead > 1e-4 && ahead < best) best = ahead;
    }
  return Number.isFinite(best) ? direction * best : 0;
}

/** A rectangle moved, and kept on the façade. */
export function moved(rect: Rect, dx: number, dy: number, { width, height }: Drawn): Rect {
  const x = Math.min(Math.max(dx, -rect[0]), width - rect[2]);
  const y = Math.min(Math.max(dy, -rect[1]), height - rect[3]);
  return tidy([rect[0] + x, rect[1] + y, rect[2] + x, rect[3] + y]);
}

/** Least size of an opening, metres. */
export const LEAST = 0.05;

/** A rectangle with some sides at other places: on the façade, and no smaller than is sensible. */
export function resized(rect: Rect, sides: Partial<Record<Side, number>>, { width, height }: Drawn): Rect {
  const own = [...rect] as Rect;
  for (const [key, value] of Object.entries(sides)) {
    const side = Number(key) as Side;
    const most = side % 2 ? height : width;
    own[side] = Math.min(Math.max(value, 0), most);
  }
  for (const [low, high] of SIDES)
    if (own[high] - own[low] < LEAST) {
      if (low in sides) own[low] = own[high] - LEAST;
      else own[high] = own[low] + LEAST;
    }
  return tidy(own);
}

/** To a tenth of a millimetre: no sums of last bits. */
export function tidy(rect: Rect): Rect {
  return rect.map((side) => Math.round(side * 1e4) / 1e4) as Rect;
}
