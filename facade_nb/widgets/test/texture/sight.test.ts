import { expect, test } from "vitest";
import { lightAt } from "../../src/pipeline/camera.ts";
import { timeOf } from "../../src/texture/controls.ts";
import { marked, offsetOf } from "../../src/texture/editor.ts";
import { coarser, rowsFor } from "../../src/texture/painting.ts";
import { cornersOf, frustumOf, seedOf, seedTable } from "../../src/texture/renderer.ts";
import { type Look, meet, outline, project, sightOf } from "../../src/texture/sight.ts";
import type { Pair, Triple } from "../../src/texture/types.ts";

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
      const place = project(sight, [...(found?.point ?? [0, 0]), 0] as Triple);
      expect(place?.[0]).toBeCloseTo(across, 9);
      expect(place?.[1]).toBeCloseTo(down, 9);
    }
    expect(meet(sight, 0.5, 0.5)?.point[0]).toBeCloseTo(4, 9);
    expect(meet(sight, 0.5, 0.5)?.point[1]).toBeCloseTo(3, 9);
  }
});

test("a place behind the façade stands where its ray meets the façade", () => {
  const sight = sightOf(LOOK, [12, 9], 1.5);
  const { point, ray } = meet(sight, 0.3, 0.6) as { point: Pair; ray: Triple };
  for (const far of [0.5, 2]) {
    const place = project(sight, [point[0] + far * ray[0], point[1] + far * ray[1], far * ray[2]]);
    expect(place?.[0]).toBeCloseTo(0.3, 9);
    expect(place?.[1]).toBeCloseTo(0.6, 9);
  }
  // Straight on, rooms lie behind their windows.
  const flat = sightOf({ ...LOOK, flat: true }, [12, 9], 1.5);
  expect(project(flat, [5, 2, -2])).toEqual(project(flat, [5, 2, 0]));
});

test("what is behind the eye is cut off an outline", () => {
  const sight = sightOf({ ...LOOK, turn: 75, rise: 0, distance: 1 }, [12, 9], 1.5);
  const facade: Triple[] = [
    [0, 0, 0],
    [12, 0, 0],
    [12, 9, 0],
    [0, 9, 0],
  ];
  expect(facade.map((corner) => project(sight, corner) === null)).toEqual([false, true, true, false]);
  const points = outline(sight, facade);
  expect(points).toHaveLength(4);
  for (const corner of [facade[0], facade[3]] as Triple[]) expect(points).toContainEqual(project(sight, corner));
  for (const [x, y] of points) expect(Number.isFinite(x) && Number.isFinite(y)).toBe(true);
  expect(
    outline(
      sight,
      facade.map(([x, y]) => [x, y, 50]),
    ),
  ).toEqual([]);
});

test("an hour is a time", () => {
  expect([0, 9.5, 11.999, 24].map(timeOf)).toEqual(["0:00", "9:30", "12:00", "24:00"]);
});

test("bands keep to their time, and grow only little by little", () => {
  expect(rowsFor(45, 20, 90)).toBe(10);
  expect(rowsFor(45, 20, 1)).toBe(80);
  expect(rowsFor(30, 1, 500)).toBe(1);
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

test("a façade's rectangle and seed are what Python gives the pipeline", () => {
  // seeds_upload([Seed.of((1e12 + 0.3, -7.7))]), and a corner of alone(…, (3, 2))
  const table = Array.from(seedTable([1e12 + 0.3, -7.7]));
  expect(table.slice(0, 4)).toEqual([10564, 19, 65535, 65043]);
  expect(table[4]).toBeCloseTo(0.203125, 6);
  expect(table[5]).toBeCloseTo(0.2, 6);
  const corners = Array.from(cornersOf([3, 2], [4, 1]));
  expect(corners.length).toBe(4 * 17);
  expect(corners.slice(34, 51)).toEqual([6, 5, 0, 6, 5, 3, 2, 4, 1, 0, 0, 0, 0, 1, 1, 0, 0]);
  const flat = frustumOf(sightOf({ ...LOOK, flat: true }, [12, 9], 1.5));
  expect(flat.parallel).toBe(true);
  expect(frustumOf(sightOf(LOOK, [12, 9], 1.5)).reach[0]).toBeGreaterThan(0);
});

test("a slow picture becomes coarser, a fast one sharp", () => {
  expect(coarser(450, 10000, 10000)).toBeCloseTo(Math.sqrt(10));
  expect(coarser(5, 10000, 10000)).toBe(1);
});

test("a line and column are an offset", () => {
  expect(offsetOf("ab\ncd", 2, 2)).toBe(4);
});

test("what is underlined is the word, number or sign at a fault", () => {
  expect(marked("S -> Layer(A)\nA -> Matt(Color)", 2, 6)).toEqual(["A -> ", "Matt"]);
  expect(marked("A -> Mat(Color, Rep:brik, -1)", 1, 17)).toEqual(["A -> Mat(Color, ", "Rep:brik"]);
  expect(marked("A -> Mat(Color, Rep:brik, -1)", 1, 27)).toEqual(["A -> Mat(Color, Rep:brik, ", "-1"]);
  expect(marked("Wände -> Füll()", 1, 10)).toEqual(["Wände -> ", "Füll"]);
  expect(marked("A -> B(§)", 1, 8)).toEqual(["A -> B(", "§"]);
  expect(marked("A ->", 1, 5)).toEqual(["A ->", " "]);
  expect(marked("", 3, 1)).toEqual(["", " "]);
});
