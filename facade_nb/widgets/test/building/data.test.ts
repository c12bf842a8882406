import { expect, test } from "vitest";
import { BuildingData, meshOf } from "../../src/building/data.ts";
import type { Packed } from "../../src/building/types.ts";
import type { WidgetModel } from "../../src/shared/types.ts";
import { FakeModel } from "../shared/fake.ts";

const PACKED: Packed = {
  varying: Float32Array.from({ length: 4 * 5 }, (_, k) => k),
  facets: Float32Array.from({ length: 2 * 12 }, (_, k) => 100 + k),
  facet: Int32Array.of(0, 0, 1, 1),
  indices: Int32Array.of(0, 1, 2, 0, 2, 3),
  turning: 6,
  shapes: Int32Array.of(0, -1),
  sunny: [0, 0, 0, 1, 1, 1],
  body: [0, 0, 0, 1, 1, 1],
  canvas: [1, 1],
  names: ["a"],
  walls: [],
  placed: Int32Array.of(0, 0, 0),
};

test("what is the same all over a flat piece comes back to each of its vertices", () => {
  const mesh = meshOf(PACKED, { stride: 68 });
  const floats = new Float32Array(mesh.vertices.buffer);
  expect([...floats.subarray(17, 34)]).toEqual([5, 6, 7, 8, 9, ...Array.from({ length: 12 }, (_, k) => 100 + k)]);
  expect([...floats.subarray(34, 51)]).toEqual([10, 11, 12, 13, 14, ...Array.from({ length: 12 }, (_, k) => 112 + k)]);
  expect([...new Uint32Array(mesh.indices.buffer)]).toEqual([0, 1, 2, 0, 2, 3]);
  expect([...mesh.corners.subarray(9)]).toEqual([0, 1, 2, 10, 11, 12, 15, 16, 17]);
});

test("a notebook is saved without what draws the picture", () => {
  const channel = new FakeModel({ works: new DataView(new ArrayBuffer(9)), mesh: new DataView(new ArrayBuffer(8)) });
  BuildingData.of(channel);
  const state = { works: channel.get("works"), mesh: channel.get("mesh"), svg: "<svg/>" };
  const saved = (channel as WidgetModel).serialize?.(state) as Record<string, DataView>;
  expect([saved.works?.byteLength, saved.mesh?.byteLength, saved.svg]).toEqual([0, 0, "<svg/>"]);
  expect(state.mesh).toBe(channel.get("mesh")); // what is in use stays
});
