import { describe, expect, it } from "vitest";
import { Detail } from "../../src/town/detail.ts";
import { type Matrix, visible } from "../../src/town/frame.ts";
import type { Chunks, Pixels, Place } from "../../src/town/types.ts";

const CHUNKS = {
  first: Int32Array.from([0, 9]),
  count: Int32Array.from([9, 3]),
  low: Float32Array.from([0, 0, 0, 20, 0, 0]),
  high: Float32Array.from([10, 10, 10, 30, 10, 10]),
} as unknown as Chunks;

/** Right triangles in the plane z = 0 with legs of these lengths, each with corners of its own. */
function mesh(legs: number[]): { indices: Uint32Array; vertices: Float32Array } {
  const vertices = legs.flatMap((leg) => [9, 0, 0, 0, 9, leg, 0, 0, 9, 0, leg, 0]); // one number before each position
  return {
    indices: Uint32Array.from(legs.flatMap((_, k) => [3 * k, 3 * k + 1, 3 * k + 2])),
    vertices: Float32Array.from(vertices),
  };
}

function sorted(legs: number[]): { detail: Detail; indices: Uint32Array } {
  const { indices, vertices } = mesh(legs);
  const detail = new Detail();
  detail.sort(0, indices, vertices, 4, 1);
  return { detail, indices };
}

const at = (away: number): Place => [5, 5, 10 + away, 0, 0, 90]; // a pixel at 1 m is 2 m wide, divided by their number
const WIDE: Pixels = [200, 100];

describe("detail", () => {
  it("has the largest triangles first, each still whole", () => {
    const { indices } = sorted([1, 5, 3]);
    expect([...indices]).toEqual([3, 4, 5, 6, 7, 8, 0, 1, 2]);
  });
  it("leaves out what is smaller than a quarter of a pixel, and nothing else", () => {
    const legs = [0.1, 0.5, 2];
    const { detail } = sorted(legs);
    for (const away of [0, 1, 10, 40, 100, 300, 1000]) {
      const pixel = (2 * away) / WIDE[0];
      const seen = legs.filter((leg) => (leg * leg) / 2 >= 0.25 * pixel * pixel).length;
      expect(detail.count(0, CHUNKS, at(away), WIDE), `${away}`).toBe(3 * seen);
    }
    expect(detail.count(0, CHUNKS, [5, 5, 5, 0, 0, 90], WIDE)).toBe(9); // one is in the midst of it
  });
  it("draws all of a chunk that was not sorted", () => {
    expect(new Detail().count(1, CHUNKS, at(5000), WIDE)).toBe(3);
  });
  it("splits runs where less is drawn, and has none of nothing", () => {
    const whole = new Float64Array([0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]) as Matrix;
    expect(visible(CHUNKS, whole)).toEqual([[0, 12]]);
    const some = (counts: number[]) => visible(CHUNKS, whole, undefined, (chunk) => counts[chunk] as number);
    expect(some([6, 3])).toEqual([
      [0, 6],
      [9, 3],
    ]);
    expect(some([0, 3])).toEqual([[9, 3]]);
    expect(some([9, 0])).toEqual([[0, 9]]);
  });
});
