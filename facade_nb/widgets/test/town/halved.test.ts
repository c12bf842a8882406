import { expect, test } from "vitest";
import { halved } from "../../src/pipeline/pipeline.ts";

test("runs are parted where what turns begins", () => {
  const runs: [number, number][] = [
    [0, 30],
    [60, 60],
    [150, 9],
  ];
  expect(halved(runs, 90, false)).toEqual([
    [0, 30],
    [60, 30],
  ]);
  expect(halved(runs, 90, true)).toEqual([
    [90, 30],
    [150, 9],
  ]);
  expect(halved(runs, 1000, true)).toEqual([]);
  expect(halved(runs, 1000, false)).toEqual(runs);
});
