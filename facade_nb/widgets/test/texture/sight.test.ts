import { expect, test } from "vitest";
import { offsetOf } from "../../src/texture/editor.ts";
import { coarser } from "../../src/texture/picture.ts";
import { lightAt, seedOf } from "../../src/texture/renderer.ts";
import { type Look, meet, project, sightOf } from "../../src/texture/sight.ts";

const LOOK: Look = { turn: 30, rise: -10, distance: 8, target: [4, 3], flat: false };

test("what a pixel meets is projected to that pixel", () => {
  for (const look of [LOOK, { ...LOOK, flat: true }]) {
    const sight = sightOf(look, [12, 9], 1.5);
    for (const [across, down] of [
      [0.5, 0.5],
      [0.2, 0.7],
      [0.8, 0.1],
    ] as const) {
      const found = meet(sight, across, down);
      const place = project(sight, found?.point ?? [0, 0]);
      expect(place?.[0]).toBeCloseTo(across, 9);
      expect(place?.[1]).toBeCloseTo(down, 9);
    }
    expect(meet(sight, 0.5, 0.5)?.point[0]).toBeCloseTo(4, 9);
    expect(meet(sight, 0.5, 0.5)?.point[1]).toBeCloseTo(3, 9);
  }
});

test("a seed is whole steps, wrapped, and a rest", () => {
  expect(seedOf([1.25, -1])).toEqual({ whole: [80, 2 ** 32 - 64], rest: [0, 0] });
  expect(seedOf([0.0078125, 0]).rest[0]).toBe(0.5);
});

test("light is mixed between the hours told", () => {
  const hours = [
    { sun: [0, 2, 4], exposure: 1 },
    { sun: [2, 2, 0], exposure: 2 },
  ];
  expect(lightAt(hours, 12)).toEqual({ sun: [1, 2, 2], exposure: 1.5 });
  expect(lightAt(hours, 24)).toEqual(hours[1]);
});

test("a slow picture becomes coarser, a fast one sharp", () => {
  expect(coarser(450, 10000, 10000)).toBeCloseTo(Math.sqrt(10));
  expect(coarser(5, 10000, 10000)).toBe(1);
});

test("a line and column are an offset", () => {
  expect(offsetOf("ab\ncd", 2, 2)).toBe(4);
});
