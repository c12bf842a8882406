import { describe, expect, it } from "vitest";
import { noiseBytes, noiseTexture } from "../../src/shared/noise.ts";

describe("the table of random numbers", () => {
  it("is Python's to the bit: render/texture/noise.py", () => {
    const own = noiseTexture();
    expect(own.length).toBe(65536);
    expect(Array.from(own.slice(0, 4), (value) => 65536 * value)).toEqual([30939, 25130, 23693, 62915]);
    // and the sum of all, each times its place
    expect(own.reduce((sum, value, k) => sum + 65536 * value * k, 0)).toBe(70342873787302);
    expect(new Set(own).size).toBe(65536);
    expect(noiseBytes().byteLength).toBe(4 * 65536);
    expect(noiseBytes()).toBe(noiseBytes()); // what has not changed isn't sent to the card again
  });
});
