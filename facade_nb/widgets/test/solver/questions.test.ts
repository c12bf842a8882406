// Whatever the views ask can be worked out from what they show, is hinted at first, and tells nothing before.

import { afterEach, describe, expect, it } from "vitest";
import { offers, Quiz } from "../../src/shared/quiz.ts";
import { quizBar } from "../../src/shared/quizbar.ts";
import { facade } from "../../src/solver/views/facade.ts";
import { VIEWS } from "../../src/solver/views/index.ts";
import { DESIGNS, type Shown, show } from "./fixtures.ts";

let one: Shown | undefined;
afterEach(() => one?.end());

async function asked(kind: keyof typeof VIEWS, design: string, name = ""): Promise<Shown & { quiz: Quiz }> {
  one = await show(VIEWS[kind] as NonNullable<(typeof VIEWS)[string]>, design);
  const { quiz } = one.view;
  if (!quiz) throw new Error("no quiz");
  quiz.ask(true);
  if (name) quiz.pose(name);
  one.go(one.player.position);
  return { ...one, quiz };
}

const rows = (selector: string): HTMLElement[] => [...(one?.view.el.querySelectorAll<HTMLElement>(selector) ?? [])];
const text = (selector: string): string =>
  rows(selector)
    .map((own) => own.textContent)
    .join(" ");
const rights = (quiz: Quiz): string[] => [...quiz.truths].filter(([, own]) => own.right).map(([key]) => key);

describe("a question", () => {
  it.each(Object.keys(VIEWS))("has a hint wherever there is one: %s", async (name) => {
    one = await show(VIEWS[name] as NonNullable<(typeof VIEWS)[string]>, "residential-house");
    const { quiz } = one.view;
    for (const stage of one.timeline.data.stages) {
      one.go(stage.last);
      quiz?.ask(true);
      for (const asked of quiz?.names ?? []) {
        quiz?.pose(asked);
        if (quiz?.truths.size) expect(quiz.hint.length).toBeGreaterThan(20);
      }
      quiz?.ask(false);
    }
  });

  it.each(["words", "candidates"])("is worked out once, not for each row: %s", async (kind) => {
    const { quiz } = await asked(kind, "residential-house");
    expect(quiz.truths.size).toBeGreaterThan(1);
    expect(quiz.truths).toBe(quiz.truths);
  });

  it("about words is of all words, wherever one stands in time", async () => {
    const { quiz } = await asked("words", "residential-house");
    const all = quiz.truths.size;
    one?.go(0);
    expect(quiz.truths.size).toBe(all);
    expect(rows(".fnb-word input")).toHaveLength(all);
  });

  it("about words is answered by lengths, bounds and partners as they are shown", async () => {
    const { quiz } = await asked("words", "figure-7");
    for (const section of rows(".fnb-words-of")) {
      const [low = 0, high = 0] =
        (section.querySelector(".fnb-eq")?.textContent ?? "").match(/[\d.]+/g)?.map(Number) ?? [];
      for (const row of section.querySelectorAll<HTMLElement>(".fnb-rows .fnb-word")) {
        const box = row.querySelector("input");
        const said = row.querySelector(".fnb-word-size")?.textContent ?? "";
        const size = Number.parseFloat(said);
        if (box && size <= high && (size >= low || said.includes("+"))) box.dispatchEvent(new Event("change"));
      }
    }
    const { wrong, missed } = quiz.check();
    expect(missed).toEqual([]);
    for (const key of wrong) expect(quiz.truths.get(key)?.why).toMatch(/another pattern/); // no partner
  });

  it("about candidates is answered by Ω and J − Ω, and by J ≥ of those that were given up", async () => {
    const { quiz } = await asked("candidates", "apartment-house");
    const head = rows(".fnb-candidate-head [role=columnheader]").map((own) => own.textContent?.replace(/ [▴▾]$/, ""));
    const at = (name: string) => head.indexOf(name);
    let [best, least] = ["", Number.POSITIVE_INFINITY];
    for (const sort of rows(".fnb-sort")) if (sort.textContent === "Ω") sort.click();
    for (const row of rows(".fnb-rows .fnb-candidate")) {
      const radio = row.querySelector("input");
      const cells = [...row.querySelectorAll("[role=cell]")].map((own) => own.textContent ?? "");
      const [omega, rest] = [cells[at("Ω")], cells[at("J − Ω")]];
      if (!radio || !omega || !rest) continue;
      const J = Number(omega) + Number(rest);
      if (J < least) [best, least] = [radio.getAttribute("aria-label")?.match(/\d+/)?.[0] ?? "", J];
    }
    quiz.choose(best);
    expect(quiz.check().right).toEqual([best]);
    expect(rights(quiz).length).toBeGreaterThan(1); // what costs as little is as right
  });

  it.each(["residential-house", "apartment-house", "figure-8", "figure-8-ida"])(
    "about edges is answered by the least g + h: %s",
    async (design) => {
      const { quiz, timeline } = await asked("network", design);
      const stages = timeline.data.stages.filter(({ stage }) => stage === "alignment");
      let found = 0;
      for (const { first, last } of stages)
        for (const position of [first + 2, Math.floor((first + last) / 2), last]) {
          one?.go(position);
          const sums = rows("[data-choice]").map((row) => {
            const [g = 0, h = 0] =
              (row.querySelector(".fnb-net-numbers")?.textContent ?? "").match(/[\d.]+/g)?.map(Number) ?? [];
            return g + h;
          });
          if (!sums.length) continue;
          found++;
          rows("[data-choice]")
            [sums.indexOf(Math.min(...sums))]?.querySelector("input")
            ?.dispatchEvent(new Event("change"));
          expect(quiz.check().wrong, `at ${position}`).toEqual([]);
          expect(quiz.done).toBe(true);
          quiz.again();
        }
      if (design === "figure-8") expect(found).toBeGreaterThan(0);
    },
  );

  it("about columns tells J with each, and the letters that there are", async () => {
    const { quiz } = await asked("alignment", "apartment-house");
    expect(text(".fnb-known")).toMatch(/ m.*μ = .* J of the whole is [\d.]+ m/);
    const whole = Number(/whole is ([\d.]+)/.exec(text(".fnb-known"))?.[1]);
    for (const [key, { right, why }] of quiz.truths)
      if (!right && why.includes("so far J is")) {
        const row = rows(".fnb-offers li").find((own) => own.querySelector(".fnb-offer-known") && !quiz.has(key));
        expect(row).toBeDefined();
      }
    const [right] = rights(quiz);
    quiz.choose(right ?? "");
    quiz.check();
    one?.go(one.player.position);
    const own = rows('.fnb-offers li[data-verdict="right"] .fnb-offer-known')[0]?.textContent ?? "";
    expect(Number(/([\d.]+) m/.exec(own)?.[1])).toBeLessThanOrEqual(whole + 0.001);
  });

  it("about sizes is answered by where letters begin and end", async () => {
    const { quiz } = await asked("sizing", "residential-house", "sizes");
    for (const row of rows(".fnb-offers li")) {
      const [likes = 0, ...ends] =
        (row.querySelector(".fnb-offer-known")?.textContent ?? "").match(/[\d.]+/g)?.map(Number) ?? [];
      const size = ends.reduce((sum, end, n) => sum + (n % 2 ? end : -end), 0);
      if (size > likes + 0.0004) row.querySelector("input")?.dispatchEvent(new Event("change"));
    }
    const { wrong, missed } = quiz.check();
    expect([wrong, missed]).toEqual([[], []]);
  });

  it("about the active set is answered by what is broken most", async () => {
    let found = 0;
    for (const design of DESIGNS) {
      const { quiz, timeline } = await asked("sizing", design);
      for (const { first, last, stage } of timeline.data.stages) {
        if (stage !== "sizing") continue;
        for (const position of [first, last]) {
          one?.go(position);
          if (!quiz.names.includes("the active set")) continue;
          quiz.pose("the active set");
          one?.go(position);
          if (!quiz.single) continue;
          const offered = rows(".fnb-offers li");
          const slack = offered.map((row) =>
            Number(/now (-?[\d.]+)/.exec((row.textContent ?? "").replace("−", "-"))?.[1]),
          );
          offered[slack.indexOf(Math.min(...slack))]?.querySelector("input")?.dispatchEvent(new Event("change"));
          const { right, wrong } = quiz.check();
          expect([right.length, wrong]).toEqual([1, []]);
          found++;
          quiz.again();
        }
      }
      one?.end();
    }
    expect(found).toBeGreaterThan(0);
  });
});

describe("while a view asks", () => {
  it("the façade does not show what it becomes", async () => {
    one = await show(facade, "residential-house");
    one.view.controls?.[0]?.click();
    one.go(0);
    expect(one.view.el.dataset.preview).toBe("");
    one.asking.set(one, 5);
    one.go(0);
    expect(one.view.el.dataset.preview).toBeUndefined();
  });
});

describe("feedback", () => {
  it("calls nothing wrong that was right, and tells nothing after the first wrong answer but a hint", () => {
    const quiz = new Quiz(() => [
      {
        prompt: "Which were rejected?",
        hint: "look at the signs",
        truths: () =>
          new Map([
            ["rejected", { right: true, why: "It was rejected." }],
            ["kept", { right: false, why: "It was kept." }],
          ]),
      },
    ]);
    const bar = quizBar(quiz, () => {});
    const list = () => offers(quiz, (key) => key);
    const states = () => [...list().querySelectorAll("li")].map((own) => own.dataset.verdict);
    const press = (name: string) =>
      [...bar.el.querySelectorAll("button")].find((own) => own.textContent === name)?.click();
    quiz.ask(true);
    quiz.choose("kept");
    bar.show();
    press("Check");
    bar.show();
    expect(states()).toEqual(["open", "open"]);
    expect(list().textContent).not.toContain("It was");
    expect(bar.el.textContent).toContain("Not yet.");
    expect(bar.el.textContent).toContain("Hint: look at the signs");
    quiz.choose("kept");
    quiz.choose("rejected");
    press("Check");
    bar.show();
    expect(states()).toEqual(["right", "passed"]);
    expect([...list().querySelectorAll(".fnb-offer-why")].map((own) => own.textContent)).toEqual([
      "✓ It was rejected.",
      "✓ It was kept.",
    ]);
  });
});
