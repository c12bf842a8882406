import { expect, it } from "vitest";
import { project, projection } from "../../src/survey/homography.ts";
import { edges, moved, nearest, next, resized } from "../../src/survey/snapping.ts";
import type { Drawn, Point, Rect } from "../../src/survey/types.ts";

const wall: Drawn = {
  name: "",
  width: 10,
  height: 5,
  corners: [],
  openings: [
    { kind: "window", rect: [1, 1, 2, 2.5] },
    { kind: "window", rect: [4, 1.1, 5, 2.6] },
  ],
};
const near = (point: Point, other: Point) => {
  for (const [k, v] of point.entries()) expect(v).toBeCloseTo(other[k] as number, 9);
};

it("takes four points to four others, and lines to lines", () => {
  const from: Point[] = [
    [180, 760],
    [1020, 850],
    [1000, 120],
    [220, 210],
  ];
  const to: Point[] = [
    [0, 900],
    [1200, 900],
    [1200, 0],
    [0, 0],
  ];
  const made = projection(from, to);
  if (!made) throw new Error("no projection");
  for (const [k, point] of from.entries()) near(project(made, point), to[k] as Point);
  // Where the diagonals meet, they meet in the rectangle, too.
  const [a, b, c, d] = from as [Point, Point, Point, Point];
  const cross = (p: Point, q: Point) => p[0] * q[1] - p[1] * q[0];
  const ac: Point = [c[0] - a[0], c[1] - a[1]];
  const bd: Point = [d[0] - b[0], d[1] - b[1]];
  const t = cross([b[0] - a[0], b[1] - a[1]], bd) / cross(ac, bd);
  near(project(made, [a[0] + t * ac[0], a[1] + t * ac[1]]), [600, 450]);
});

it("makes nothing of corners on one line", () => {
  const line: Point[] = [
    [0, 0],
    [1, 0],
    [2, 0],
    [0, 1],
  ];
  expect(
    projection(line, [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 1],
    ]),
  ).toBeNull();
});

it("snaps to the nearest edge of another opening or of the façade, within reach", () => {
  const across = edges(wall, 0, 1);
  expect(across).toEqual([1, 2, 0, 10]);
  expect(nearest([1.06, 2.3], across, 0.1)).toBeCloseTo(-0.06);
  expect(nearest([1.3, 2.3], across, 0.1)).toBeNull();
  expect(next([4, 5], across, -1)).toBe(-2);
  expect(next([4, 5], across, 1)).toBe(5);
  expect(next([1.1, 2.6], edges(wall, 1, 1), -1)).toBeCloseTo(-0.1);
  expect(next([10], across, 1)).toBe(0);
});

it("keeps openings on the façade, and of a size", () => {
  const rect: Rect = [4, 1, 5, 2.5];
  expect(moved(rect, 9, -9, wall)).toEqual([9, 0, 10, 1.5]);
  expect(resized(rect, { 2: 3 }, wall)).toEqual([4, 1, 4.05, 2.5]);
  expect(resized(rect, { 0: 9, 3: 99 }, wall)).toEqual([4.95, 1, 5, 5]);
});
