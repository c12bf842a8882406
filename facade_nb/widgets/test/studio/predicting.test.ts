import { describe, expect, it } from "vitest";
import { questionsOf, widthOf } from "../../src/studio/predicting.ts";

const told = {
  width: 9,
  counts: [{ pattern: "Bx", symbol: "B", now: 3, later: 5, length: [5.6, 9] as [number, number] }],
  moves: [
    { symbol: "A", by: 0.03, count: 6, most: true },
    { symbol: "B", by: -0.03, count: 5, most: true },
    { symbol: "C", by: 0, count: 2, most: false },
  ],
};

describe("prediction in the studio", () => {
  it("asks about another width each time, never the present one", () => {
    expect([0, 1, 2, 3, 4].map((round) => widthOf(6, round))).toEqual([9, 4.5, 12, 7.5, 10.5]);
    expect(widthOf(0.5, 3)).toBe(1);
  });

  it("asks for a number that can be worked out from the hint, and takes the solver's", () => {
    const [many, gives] = questionsOf(told);
    expect(many?.prompt).toBe("The canvas becomes 9 m wide. How many B will Bx have? Now there are 3.");
    expect(many?.hint).toContain("Bx is 5.6 m long now. Each B more or less, with what stands beside it, makes 1.7 m.");
    const truths = [...(many?.truths() ?? [])];
    expect(truths.map(([key, { right }]) => [key, right])).toEqual([
      ["2", false],
      ["3", false],
      ["4", false],
      ["5", true],
      ["6", false],
    ]);
    // Of two that give way alike each is right: none of them may be painted red.
    expect([...(gives?.truths() ?? [])].map(([key, { right }]) => [key, right])).toEqual([
      ["A", true],
      ["B", true],
      ["C", false],
    ]);
  });

  it("says why nothing can be asked", () => {
    expect(questionsOf(null)[0]?.prompt).toContain("works it out");
    const [none] = questionsOf({ ...told, counts: [], moves: [] });
    expect(none?.prompt).toContain("Nothing can be asked");
    expect(none?.truths().size).toBe(0);
  });
});
