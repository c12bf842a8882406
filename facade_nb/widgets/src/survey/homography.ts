// How a plane in a photograph becomes straight: the projection that takes four points to four others.

import type { Point } from "./types.ts";

/** The eight numbers of a projection: x' = (ax + by + c) / (gx + hy + 1), y' = (dx + ey + f) / (gx + hy + 1). */
export type Projection = [number, number, number, number, number, number, number, number];

/** The projection that takes four points to four others; null where three of them are on one line. */
export function projection(from: readonly Point[], to: readonly Point[]): Projection | null {
  const rows = from.flatMap(([x, y], k) => {
    const [u, v] = to[k] as Point;
    return [
      [x, y, 1, 0, 0, 0, -u * x, -u * y, u],
      [0, 0, 0, x, y, 1, -v * x, -v * y, v],
    ];
  });
  const n = rows.length;
  for (let i = 0; i < n; i += 1) {
    let best = i;
    for (let k = i + 1; k < n; k += 1) if (Math.abs(at(rows, k, i)) > Math.abs(at(rows, best, i))) best = k;
    [rows[i], rows[best]] = [rows[best] as number[], rows[i] as number[]];
    const pivot = at(rows, i, i);
    if (Math.abs(pivot) < 1e-12) return null;
    for (let k = 0; k < n; k += 1) {
      if (k === i) continue;
      const by = at(rows, k, i) / pivot;
      for (let j = i; j <= n; j += 1) (rows[k] as number[])[j] = at(rows, k, j) - by * at(rows, i, j);
    }
  }
  return rows.map((_, i) => at(rows, i, n) / at(rows, i, i)) as Projection;
}

function at(rows: number[][], i: number, j: number): number {
  return (rows[i] as number[])[j] as number;
}

export function project([a, b, c, d, e, f, g, h]: Projection, [x, y]: Point): Point {
  const w = g * x + h * y + 1;
  return [(a * x + b * y + c) / w, (d * x + e * y + f) / w];
}

/** The same for an element, whose own units are pixels from its upper left. */
export function cssOf([a, b, c, d, e, f, g, h]: Projection): string {
  return `matrix3d(${[a, d, 0, g, b, e, 0, h, 0, 0, 1, 0, c, f, 0, 1].map((v) => v.toFixed(12)).join(",")})`;
}
