import { afterEach, describe, expect, it } from "vitest";
import { unpack } from "../../src/shared/packing.ts";
import { type GroupNote, judge, type WordEvent } from "../../src/solver/bounds.ts";
import { target } from "../../src/solver/links.ts";
import { words } from "../../src/solver/views/words.ts";
import { pieceOf, type Shown, show } from "./fixtures.ts";

let one: Shown;
afterEach(() => one?.end());

const text = (selector: string, within: ParentNode = one.view.el): string[] =>
  [...within.querySelectorAll(selector)].map((element) => element.textContent ?? "");
const section = (pattern: string): HTMLElement =>
  one.view.el.querySelector<HTMLElement>(`[data-pattern="${pattern}"]`) as HTMLElement;
const table = (pattern: string): string[][] =>
  [...section(pattern).querySelectorAll(".fnb-rows .fnb-word")].map((row) =>
    text("[role=cell]:not(.fnb-scale)", row as HTMLElement).map((cell) => cell.trim()),
  );

describe("the paper's Figure 7", () => {
  it("comes out with its words, sizes and six candidates", async () => {
    one = await show(words, "figure-7", { tolerance: 1, step: 1 });
    const fitting = (pattern: string) => table(pattern).filter((row) => !/too/.test(row.at(-1) ?? ""));
    expect(fitting("balconies").map((row) => row.slice(0, -1))).toEqual([
      ["1", "4", "eBe", "11"],
      ["1", "3", "eBe", "9"],
      ["2", "2", "eB2e", "10"],
      ["3", "1", "eB3e", "11"],
    ]);
    expect(fitting("rooms").map((row) => row.slice(0, -1))).toEqual([
      ["1", "4", "AC4A", "9.2"],
      ["1", "5", "AC5A", "10.5"],
      ["2", "1", "A2CA2", "9.3"],
      ["2", "2", "A2C2A2", "10.6"],
    ]);
    expect(section("balconies").querySelector(".fnb-eq")?.textContent).toBe("9 ≤ |w| ≤ 11 m");
    const rows = [...one.view.el.querySelectorAll(".fnb-tuples tr")].map((row) => text("td", row));
    const columns = (rows[0] ?? []).map((_, n) => rows.map((row) => row[n]).join(" ")).sort();
    expect(columns).toEqual(
      [
        "(1, 5) 4 eBe AC5A",
        "(1, 5) 3 eBe AC5A",
        "(1, 4) 4 eBe AC4A",
        "(1, 4) 3 eBe AC4A",
        "(2, 2) 2 eB2e A2C2A2",
        "(2, 1) 2 eB2e A2CA2",
      ].sort(),
    );
  });

  it("draws each word to scale", async () => {
    one = await show(words, "figure-7", { tolerance: 1, step: 1 });
    const row = section("rooms").querySelector<HTMLElement>('[aria-label="9.2 metres of 10"]') as HTMLElement;
    const boxes = [...row.querySelectorAll<HTMLElement>(".fnb-box")].map((box) => parseFloat(box.style.width));
    const line = parseFloat(row.querySelector<HTMLElement>(".fnb-canvas-line")?.style.left ?? "0");
    const metre = line / 10;
    expect(boxes.map((width) => Number((width / metre).toFixed(2)))).toEqual([2, 1.3, 1.3, 1.3, 1.3, 2]);
    const band = row.querySelector<HTMLElement>(".fnb-band") as HTMLElement;
    expect(parseFloat(band.style.left) / metre).toBeCloseTo(9, 3);
    expect(parseFloat(band.style.width) / metre).toBeCloseTo(2, 3);
  });
});

describe("the bounds of Eq. 7", () => {
  it.each(["figure-7", "residential-house", "apartment-house", "supplement-3.1"])(
    "are the solver's: %s",
    async (design) => {
      type Told = WordEvent & { event: string; axis: string; groups: GroupNote[]; canvas: number };
      const { events } = await unpack<{ events: Told[] }>(pieceOf(design, "words"));
      for (const axis of ["x", "y"]) {
        const posed = events.find((event) => event.event === "AxisPosed" && event.axis === axis) as Told;
        const told = events.filter((event) => event.event === "WordJudged" && event.axis === axis);
        const byPattern = new Map<string, WordEvent[]>();
        for (const event of told) byPattern.set(event.pattern, [...(byPattern.get(event.pattern) ?? []), event]);
        const judged = judge(byPattern, posed.groups, posed.canvas, told[0]?.tolerance ?? 0, null);
        for (const event of told) {
          const own = judged.get(event.pattern);
          if (event.low !== null) expect(own?.low).toBeCloseTo(event.low, 9);
          expect(own?.high).toBeCloseTo(event.high, 9);
          const word = own?.words.find((each) => each.event === event);
          expect(word?.reason === "too long" || word?.reason === "too short").toBe(/^too/.test(event.reason));
        }
      }
    },
  );
});

describe("alternation and mirrors", () => {
  it("the choice stands in a column of its own, mirrored letters have a dash", async () => {
    one = await show(words, "alternation");
    const heads = text('[data-pattern="P"] .fnb-word-head [role=columnheader]');
    expect(heads.slice(0, 3)).toEqual(["k", "choice", "w1"]);
    const rows = table("P").map((row) => row.slice(0, 3));
    expect(rows).toContainEqual(["1", "<door>", "⟨door⟩B′A′"]);
    expect(rows).toContainEqual(["2", "A", "A2B′A′"]);
    expect(rows).toContainEqual(["1", "B", "BB′A′"]);
  });
});

describe("the words", () => {
  it("come one by one", async () => {
    one = await show(words, "figure-7");
    const { first, last } = one.timeline.data.stages.find((s) => s.stage === "words" && s.axis === "x") ?? {
      first: 0,
      last: 0,
    };
    one.go(first);
    expect(table("rooms").length + table("balconies").length).toBe(0);
    expect(one.view.el.querySelector(".fnb-empty")?.textContent).toContain("No word has been judged yet");
    const begun = one.timeline.data.kinds.indexOf("WordJudged");
    for (let at = first; at < last; at++) {
      if (one.timeline.data.kind[at] !== begun) continue;
      one.go(at);
      const now = [...one.view.el.querySelectorAll("[data-now]")];
      expect(now.length, `at ${at}`).toBe(1);
      expect(now[0]?.nextElementSibling, "it is the last of its table").toBeNull();
    }
    expect(one.view.el.querySelectorAll(".fnb-tuples table").length).toBe(1);
  });

  it("say why they are dropped", async () => {
    one = await show(words, "figure-7", { tolerance: 1, step: 1 });
    const row = [...section("rooms").querySelectorAll<HTMLElement>(".fnb-word")].find((each) =>
      /AC6A/.test(each.textContent ?? ""),
    );
    expect(row?.textContent).toContain("✕ too long by 0.8");
    expect(row?.title).toBe("11.8 m is longer than canvas + μ = 11 m.");
  });

  it("come into sight when a candidate with them is chosen", async () => {
    one = await show(words, "apartment-house");
    const list = section("Mx").querySelector(".fnb-rows") as HTMLElement;
    expect(list.scrollTop).toBe(0);
    one.links.pick([target.word("x", "Mx", `f A ${"B D ".repeat(20)}B A f'`)]);
    one.view.light?.();
    expect(section("Mx").querySelector(".fnb-word[data-chosen] .fnb-word-text")?.textContent).toBe("fA(BD)20BAf′");
    await new Promise(requestAnimationFrame);
    expect(list.scrollTop).toBeGreaterThan(0);
  });

  it("light up with the candidate that takes them", async () => {
    one = await show(words, "residential-house");
    one.links.hover([target.word("x", "Bx", "A B A B A B A")]);
    one.links.apply(one.view.el);
    const lit = [...one.view.el.querySelectorAll(".fnb-word[data-lit] .fnb-word-text")].map((e) => e.textContent);
    expect(lit).toEqual(["(AB)3A"]);
  });

  it("say what the looks of letters mean, as far as they occur", async () => {
    one = await show(words, "figure-7");
    const legend = () => text(".fnb-legend > span", one.view.el).map((own) => own.replace(/^(A|a|B)/, ""));
    expect(legend()).toEqual([
      "a letter, in its symbol's colour",
      "not opaque",
      "transparent: it may be cut",
      "its size is free",
    ]);
    one.end();
    one = await show(words, "residential-house");
    expect(legend()).not.toContain("mirrored");
  });

  it("can be predicted", async () => {
    one = await show(words, "figure-7", { tolerance: 1, step: 1 });
    const quiz = one.view.quiz;
    if (!quiz) throw new Error("no quiz");
    quiz.ask(true);
    one.go(one.player.position);
    expect(one.view.el.textContent).not.toMatch(/too long|✓|no partner/);
    expect(one.view.el.querySelector(".fnb-tuples")?.textContent).toBe("");
    const box = (word: RegExp) =>
      [...section("rooms").querySelectorAll<HTMLElement>(".fnb-word")]
        .find((e) => word.test(e.querySelector(".fnb-word-text")?.textContent ?? ""))
        ?.querySelector("input");
    for (const word of [/^AC4A$/, /^AC6A$/]) box(word)?.dispatchEvent(new Event("change"));
    quiz.help();
    const answer = quiz.check();
    one.go(one.player.position);
    expect([answer.right.length, answer.wrong.length, answer.missed.length]).toEqual([1, 1, 6]);
    expect(quiz.outcome()).toBe("1 right, 1 wrong, 6 missed.");
    const states = [...section("rooms").querySelectorAll<HTMLElement>(".fnb-rows .fnb-word")].map((row) => [
      row.querySelector(".fnb-word-text")?.textContent,
      row.dataset.verdict,
    ]);
    expect(states).toContainEqual(["AC4A", "right"]);
    expect(states).toContainEqual(["AC6A", "wrong"]);
    expect(states).toContainEqual(["AC5A", "missed"]);
    const wrong = [...one.view.el.querySelectorAll<HTMLElement>("[data-verdict=wrong]")];
    expect(wrong.map((row) => row.title)).toEqual(["11.8 m is longer than canvas + μ = 11 m."]);
    expect(wrong[0]?.textContent).toContain("too long by 0.8");
  });
});
