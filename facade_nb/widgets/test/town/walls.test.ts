import { describe, expect, it } from "vitest";
import { KEPT, type Spot, Walls } from "../../src/town/walls.ts";

/** The walls of houses with these corners. */
const houses = (...rings: Spot[][]): Walls =>
  new Walls(
    Float32Array.from(
      rings.flatMap((ring) => ring.flatMap((spot, k) => [...spot, ...(ring[(k + 1) % ring.length] as Spot)])),
    ),
  );
const square = (x: number, z: number, side: number): Spot[] => [
  [x, z],
  [x, z + side],
  [x + side, z + side],
  [x + side, z],
];

describe("one who walks", () => {
  const walls = houses(square(0, 0, 10), square(60, -35, 8));

  it("stops before a wall, as far as one keeps from it", () => {
    const at = walls.walk([5, 20], [5, -20]);
    expect(at[0]).toBeCloseTo(5, 5);
    expect(at[1]).toBeCloseTo(10 + KEPT, 3);
  });

  it.each([0.05, 3, 400])("does not get through a wall in steps of %s m, from any side", (step) => {
    for (let turn = 0; turn < 24; turn += 1) {
      const angle = (turn * Math.PI) / 12;
      let at: Spot = [5 + 12 * Math.cos(angle), 5 + 12 * Math.sin(angle)];
      for (let k = 0; k < Math.min(400, Math.ceil(30 / step)); k += 1) {
        at = walls.walk(at, [at[0] - step * Math.cos(angle), at[1] - step * Math.sin(angle)]);
        expect(walls.within(at), `${turn}: ${at}`).toBe(false);
      }
    }
  });

  it("goes along a wall that it meets aslant", () => {
    const at = walls.walk([2, 10.6], [6, 9.6]);
    expect(at[0]).toBeGreaterThan(5);
    expect(at[1]).toBeCloseTo(10 + KEPT, 2);
  });

  it("goes freely where there are no walls", () => {
    const at = walls.walk([-30, 40], [-70, 15]);
    expect(at[0]).toBeCloseTo(-70, 5);
    expect(at[1]).toBeCloseTo(15, 5);
  });

  it("does not squeeze through a corner between two walls", () => {
    const corner = houses([
      [0, 0],
      [0, 10],
      [10, 10],
      [10, 9],
      [1, 9],
      [1, 0],
    ]);
    let at: Spot = [3, 5];
    for (let k = 0; k < 50; k += 1) {
      at = corner.walk(at, [at[0] - 0.3, at[1] + 0.3]);
      expect(corner.within(at)).toBe(false);
      expect(at[0]).toBeGreaterThan(1);
      expect(at[1]).toBeLessThan(9);
    }
  });

  it("begins out of doors, wherever it stood", () => {
    expect(walls.within([5, 5])).toBe(true);
    const at = walls.outside([5, 5]);
    expect(walls.within(at)).toBe(false);
    expect(Math.hypot(at[0] - 5, at[1] - 5)).toBeLessThan(9);
    expect(walls.outside([30, 30])).toEqual([30, 30]);
  });

  it("knows courtyards", () => {
    const court = houses(square(0, 0, 30), square(10, 10, 8).reverse());
    expect(court.within([5, 5])).toBe(true);
    expect(court.within([14, 14])).toBe(false);
    expect(court.walk([14, 14], [14, 60])[1]).toBeCloseTo(18 - KEPT, 3);
  });

  it("goes where it likes in a town without walls", () => {
    expect(new Walls(new Float32Array()).walk([0, 0], [0, 50])[1]).toBeCloseTo(50, 5);
  });
});
