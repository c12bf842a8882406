import { describe, expect, it } from "vitest";
import { daylight, frustumOf, matrixOf, uniformsOf, visible } from "../../src/town/frame.ts";
import { along } from "../../src/town/path.ts";
import type { Chunks, Pixels, Place, Stop } from "../../src/town/types.ts";
import told from "./frames.json" with { type: "json" };

const near = (found: unknown, expected: unknown, name: string) => {
  const [a, b] = [found, expected].map((value) =>
    typeof value === "number" ? [value] : Array.from(value as number[]),
  );
  expect(a?.length, name).toBe(b?.length);
  a?.forEach((value, k) => {
    const wanted = b?.[k] as number;
    expect(Math.abs(value - wanted), `${name}[${k}]: ${value}, expected ${wanted}`).toBeLessThanOrEqual(
      1e-5 * Math.max(1, Math.abs(wanted)),
    );
  });
};

const chunks = {
  first: Int32Array.from(told.chunks.first),
  count: Int32Array.from(told.chunks.count),
  low: Float32Array.from(told.chunks.low),
  high: Float32Array.from(told.chunks.high),
} as Chunks;

describe.each(told.cases.map((one) => [one.hour, one] as const))("a frame at %s", (hour, one) => {
  const frustum = frustumOf(one.place as Place, one.pixels as Pixels);
  const light = daylight(told.hours, hour);
  const looks = { shadow: true, occlusion: true };
  const values = uniformsOf(told.head, frustum, light, one.pixels as Pixels, looks);

  it("has the values that Python tells its shaders", () => {
    expect(Object.keys(values).sort()).toEqual(Object.keys(one.uniforms).sort());
    for (const [name, value] of Object.entries(one.uniforms)) near(values[name], value, name);
  });

  it("draws the chunks that Python draws", () => {
    for (const [name, runs] of Object.entries(one.runs))
      expect(visible(chunks, values[name] as Float64Array), name).toEqual(runs);
  });
});

describe("a chunk", () => {
  it("is left out while it has not come", () => {
    const through = matrixOf(frustumOf(told.cases[0]?.place as Place, [640, 400]));
    const all = visible(chunks, through).reduce((sum, [, count]) => sum + count, 0);
    const some = visible(chunks, through, (chunk) => chunk % 2 === 0).reduce((sum, [, count]) => sum + count, 0);
    expect(some).toBeGreaterThan(0);
    expect(some).toBeLessThan(all);
  });
});

describe("a path", () => {
  it.each(told.along as [number, number[]][])("at %s s is where Python says", (time, place) => {
    near(along(told.path as Stop[], time), place, "place");
  });
});
