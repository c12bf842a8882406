import { afterEach, describe, expect, it } from "vitest";
import { offers, same } from "../../src/solver/equations.ts";
import { target } from "../../src/solver/links.ts";
import { analysis } from "../../src/solver/views/analysis.ts";
import { type Shown, show } from "./fixtures.ts";

let one: Shown;
afterEach(() => one?.end());

const texts = (selector: string, within: ParentNode = one.view.el): string[] =>
  [...within.querySelectorAll(selector)].map((element) => element.textContent ?? "");

describe("pattern analysis", () => {
  it("shows the supplement's example: common ends greyed, m + 2 = l", async () => {
    one = await show(analysis, "supplement-3.1");
    expect(texts(".fnb-pair-prefix")).toEqual(["Ak", "Ak"]);
    expect(texts(".fnb-pair-middle")).toEqual(["Cm+2", "Cl"]);
    expect(texts(".fnb-pair-middle sup")).toEqual(["m+2", "l"]);
    expect(texts(".fnb-pair-equation")).toEqual(["⇒ m + 2 = l"]);
    expect(texts(".fnb-strength")).toEqual(["binding"]);
    expect(texts('[data-system="counters"] li .fnb-system-text')).toEqual(["m = l − 2"]);
    expect(texts('[data-system="counters"] .fnb-free')).toEqual(["k", "l"]);
    expect(one.view.el.querySelector("[data-conflict]")).toBeNull();
  });

  it("shows the pair that contradicts itself in red, from its event on", async () => {
    one = await show(analysis, "contradiction");
    const conflict = one.view.el.querySelector("[data-conflict]");
    expect(conflict?.textContent).toContain("2m + 1 = 2l; no whole numbers satisfy that");
    expect(texts(".fnb-system .fnb-pair-conflict")).toEqual(["(1) cannot hold."]);
    const told = one.timeline.data.marks.find((each) => each.kind === "PairInconsistent");
    one.go((told?.at ?? 0) - 1);
    expect(one.view.el.querySelector("[data-conflict]")).toBeNull();
    expect(texts(".fnb-pair-equation")).toEqual(["⇒ 2m + 1 = 2l"]);
  });

  it("names the equations that a contradiction is against", async () => {
    one = await show(analysis, "apartment-house");
    const numbers = (selector: string) => texts(`${selector} .fnb-pair-number`);
    expect(numbers("[data-conflict]")).toEqual(["(4)", "(8)"]);
    expect(numbers("[data-against]")).toEqual(["(2)"]);
    expect(texts('[data-resolved=""] .fnb-system-text')).toEqual(["|f| = 3.6"]);
  });

  it("comes pair by pair, then the systems", async () => {
    one = await show(analysis, "apartment-house");
    const stage = one.timeline.data.stages.find((each) => each.stage === "analysis" && each.axis === "x");
    const counts: [number, number][] = [];
    for (let at = stage?.first ?? 0; at <= (stage?.last ?? 0); at++) {
      one.go(at);
      counts.push([texts(".fnb-pair").length, texts(".fnb-system").length]);
    }
    expect(counts[0]).toEqual([0, 0]);
    expect(counts.at(-1)).toEqual([8, 2]);
    for (const [n, [pairs, systems]] of counts.entries()) {
      expect(pairs).toBeGreaterThanOrEqual(counts[n - 1]?.[0] ?? 0);
      if (systems) expect(pairs).toBe(8);
    }
  });

  it("lights up with counters, symbols and the rows that follow", async () => {
    one = await show(analysis, "apartment-house");
    const lit = () => {
      one.links.apply(one.view.el);
      return texts(".fnb-pair[data-lit] .fnb-pair-number");
    };
    one.links.hover([target.counter("m")]);
    expect(lit()).toEqual(["(5)", "(7)", "(8)"]);
    one.links.hover([target.equation("x", 1)]);
    expect(lit()).toEqual(["(2)"]);
    expect(texts("li[data-lit] .fnb-system-text")).toHaveLength(3); // the rows that follow from it
  });

  it("can be predicted: what contradicts, and what is fixed", async () => {
    one = await show(analysis, "apartment-house", {});
    const stage = one.timeline.data.stages.find((each) => each.stage === "analysis" && each.axis === "x");
    one.go(stage?.first ?? 0); // before anything is told
    const quiz = one.view.quiz;
    if (!quiz) throw new Error("no quiz");
    quiz.ask(true);
    one.go(one.player.position);
    expect(texts(".fnb-pair").length).toBe(8);
    expect(one.view.el.querySelector("[data-conflict], [data-against], li[data-resolved]")).toBeNull();
    expect(texts(".fnb-system-text")).toEqual([]);
    const tick = (label: string) =>
      [...one.view.el.querySelectorAll(".fnb-analysis-choice")]
        .find((each) => each.textContent === label)
        ?.querySelector("input")
        ?.dispatchEvent(new Event("change"));
    tick("(4) contradicts those before");
    one.go(one.player.position);
    tick("(5) contradicts those before");
    one.go(one.player.position);
    tick("|f| is fixed");
    quiz.help();
    const { right, wrong, missed } = quiz.check();
    one.go(one.player.position);
    expect(right).toEqual([target.equation("x", 3), target.variable("x", "unsized |f|")]);
    expect(wrong).toEqual([target.equation("x", 4)]);
    expect(missed).toEqual([target.equation("x", 7)]);
    const said = texts(".fnb-analysis-choice[data-verdict]").join("|");
    expect(said).toContain("(5) contradicts those before✕ It holds together with those before it.");
    expect(said).toContain("|f| is fixed✓ |f| = 3.6");
    // What contradicts was right to be chosen: nothing about it is red.
    expect(one.view.el.querySelector("[data-conflict], [data-against], .fnb-pair-conflict")).toBeNull();
    expect(texts(".fnb-known")[0]).toContain("A is 0.8 m, B is 1.2 m");
    quiz.ask(false);
    one.go(one.player.position);
    expect(texts(".fnb-pair")).toEqual([]); // the moment is what it was
  });

  it("asks what the equation of a pair says, among others that do not say the same", async () => {
    one = await show(analysis, "supplement-3.1");
    const quiz = one.view.quiz;
    if (!quiz) throw new Error("no quiz");
    quiz.ask(true);
    expect(quiz.names).toEqual(["all pairs", "pair (1)"]);
    quiz.pose("pair (1)");
    one.go(one.timeline.data.stages[0]?.first ?? 0);
    expect(quiz.prompt).toBe("What does the equation of pair (1) say?");
    expect(texts(".fnb-pair-follows")).toEqual(["⇒ ?"]);
    expect(texts(".fnb-system")).toEqual([]);
    expect(new Set(texts(".fnb-offer-what"))).toEqual(new Set(["m = l", "m − 2 = l", "m + 2 = l"]));
    [...one.view.el.querySelectorAll("li")]
      .find((own) => own.textContent === "m − 2 = l")
      ?.querySelector("input")
      ?.dispatchEvent(new Event("change"));
    quiz.help();
    expect(quiz.check()).toEqual({ right: [], wrong: ["m − 2 = l"], missed: [] });
    one.go(one.player.position);
    expect(quiz.outcome()).toBe("No. 2 has the wrong sign: look on which line more is left.");
    expect(texts("li[data-verdict=missed]")[0]).toContain("missed: What is left of both lines is equally long.");
    expect(texts(".fnb-pair-follows")).toEqual(["⇒ m + 2 = lbinding"]);
  });

  it("knows when two equations say the same", () => {
    expect(same("m + 2 = l", "2l = 2m + 4")).toBe(true);
    expect(same("m + 2 = l", "m − 2 = l")).toBe(false);
    expect(same("2|f| = |g| − 1.5j + 4.4", "|g| = 2|f| + 1.5j − 4.4")).toBe(true);
    expect(same("0 = 0.2", "0.4 = 0")).toBe(true);
    expect(same("0.1k = 0", "k = 0")).toBe(true);
    expect(offers("k = 0", []).filter(({ right }) => right)).toHaveLength(1);
  });
});
