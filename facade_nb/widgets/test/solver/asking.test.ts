// While a view asks, what gives its answer away is kept back everywhere.

import { afterEach, describe, expect, it } from "vitest";
import { VIEWS } from "../../src/solver/views/index.ts";
import { player } from "../../src/solver/views/player.ts";
import { type Shown, show } from "./fixtures.ts";

let shown: Shown[] = [];
afterEach(() => {
  for (const one of shown.splice(0)) one.end();
  shown = [];
});

/** Kinds of events that tell what a view asks for. */
const TELL: Record<string, string[]> = {
  analysis: ["PatternsCompared", "SystemReduced", "PairInconsistent", "WordJudged"],
  words: ["WordJudged", "CandidateJudged"],
  candidates: ["WordJudged", "CandidateJudged", "PathChosen"],
  network: ["PathChosen"],
  alignment: ["PathChosen", "StructurePriced", "LetterPlaced"],
  sizing: ["SystemSolved", "LetterPlaced"],
};

describe("what a view asks", () => {
  it.each(Object.keys(TELL))("is told by no event before the one that it names: %s", async (name) => {
    const kind = VIEWS[name];
    if (!kind) throw new Error(`no view ${name}`);
    const one = await show(kind, "residential-house");
    shown.push(one);
    const { timeline, view } = one;
    const { quiz } = view;
    if (!quiz) throw new Error(`${name} asks nothing`);
    quiz.ask(true);
    for (const stage of timeline.data.stages)
      for (const at of [stage.first, stage.last]) {
        one.go(at);
        for (const asked of quiz.names) {
          quiz.pose(asked);
          one.go(at);
          if (!quiz.truths.size) continue;
          const axis = timeline.axisAt(at);
          const told = Array.from({ length: quiz.from }, (_, n) => n).filter((n) => timeline.axisAt(n) === axis);
          const telling = told.filter((n) => TELL[name]?.includes(timeline.kindAt(n)));
          expect(telling, `${asked} at ${timeline.momentOf(at)}`).toEqual([]);
        }
      }
  });
});

describe("the events", () => {
  const listed = ({ view }: Shown): string[] =>
    [...view.el.querySelectorAll(".fnb-event-at")].map((each) => each.textContent ?? "");

  it("that would tell an answer are not in the list while it is asked for", async () => {
    const one = await show(player, "residential-house");
    shown.push(one);
    const kept = one.view.el.querySelector<HTMLElement>(".fnb-events-kept");
    const before = one.view.el.innerHTML;
    expect(kept?.hidden).toBe(true);
    one.asking.set(one, 40);
    one.go(one.player.position);
    expect(listed(one).at(-1)).toBe("40");
    expect(one.view.el.querySelector("[aria-rowcount]")?.getAttribute("aria-rowcount")).toBe("40");
    expect(one.view.el.querySelector("[data-now]")).toBeNull();
    expect(kept?.textContent).toBe(`Events 41 to ${one.timeline.count}: kept back while a view asks`);
    // Of two questions the one whose answer is told first says it.
    one.asking.set(kept as object, 7);
    one.go(3);
    expect(listed(one)).toEqual(["1", "2", "3", "4", "5", "6", "7"]);
    expect(one.view.el.querySelector("[data-now] .fnb-event-at")?.textContent).toBe("4");
    one.asking.set(one, null);
    one.asking.set(kept as object, null);
    one.go(one.timeline.last);
    expect(one.view.el.innerHTML).toBe(before);
  });
});
