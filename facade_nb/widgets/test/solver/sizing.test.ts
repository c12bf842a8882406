import { afterEach, describe, expect, it } from "vitest";
import { unpack } from "../../src/shared/packing.ts";
import { target } from "../../src/solver/links.ts";
import type { PathNote } from "../../src/solver/network/story.ts";
import { entering } from "../../src/solver/sizing/question.ts";
import { type SizingEvent, System, type SystemPosed, writtenOut } from "../../src/solver/sizing/system.ts";
import type { Axis } from "../../src/solver/timeline.ts";
import { sizing } from "../../src/solver/views/sizing.ts";
import { pieceOf, type Shown, show } from "./fixtures.ts";

let one: Shown;
afterEach(() => one?.end());

async function systemOf(design: string, axis: Axis = "x"): Promise<System> {
  const { events } = await unpack<{ events: SizingEvent[] }>(pieceOf(design, "sizing"));
  const { paths } = await unpack<{ paths: PathNote[] }>(pieceOf(design, "alignment"));
  const posed = events.find((own): own is SystemPosed => own.event === "SystemPosed" && own.axis === axis);
  return new System(
    posed as SystemPosed,
    events,
    paths.filter((path) => path.axis === axis),
  );
}

const texts = (selector: string, within: ParentNode = one.view.el): string[] =>
  [...within.querySelectorAll(selector)].map((element) => (element.textContent ?? "").trim());
const horizontal = () => one.view.controls?.[0]?.querySelectorAll("button")[1]?.click();
const tab = (text: string) =>
  [...one.view.el.querySelectorAll<HTMLElement>(".fnb-size-tabs button")]
    .find((own) => own.textContent === text)
    ?.click();

describe("the system of (CeC, ABABA)", () => {
  it("has the equations of the supplement's Figure 7, by its names", async () => {
    one = await show(sizing, "figure-8");
    horizontal();
    const rows = texts(".fnb-size-text");
    expect(rows.slice(0, 8)).toEqual([
      "1-1-1.t − 1-1-1.s = |C|",
      "1-5-1.t − 1-5-1.s = |C|",
      "2-1-1.t − 2-1-1.s = |A|",
      "2-2-1.t − 2-2-1.s = |B|",
      "2-3-1.t − 2-3-1.s = |A|",
      "2-4-1.t − 2-4-1.s = |B|",
      "2-5-1.t − 2-5-1.s = |A|",
      "(1-2-1.t − 1-2-1.s) + (1-3-1.t − 1-3-1.s) + (1-4-1.t − 1-4-1.s) = |e|",
    ]);
    expect(rows.slice(8, 10)).toEqual(["x0 = 0", "x5 = 12"]);
  });

  it("is written out letter by letter: order, stitches, ends, one size for a symbol, shared columns", async () => {
    const { objective, constraints } = writtenOut(await systemOf("figure-8"), 0);
    expect(objective.map(({ text }) => text)).toEqual([
      "(1-1-1.t − 1-1-1.s − 2)²",
      "(2-1-1.t − 2-1-1.s − 2)²",
      "(2-2-1.t − 2-2-1.s − 3)²",
    ]);
    const of = (kind: string) => constraints.filter((own) => own.kind === kind).map(({ text }) => text);
    expect(of("ends")).toEqual(["1-1-1.s = 0", "1-5-1.t = 12", "2-1-1.s = 0", "2-5-1.t = 12"]);
    expect(of("order")).toHaveLength(10);
    expect(of("stitch")).toHaveLength(8);
    expect(of("size")).toContain("2-3-1.t − 2-3-1.s = 2-1-1.t − 2-1-1.s");
    expect(of("column")).toHaveLength(10);
    expect(of("column")[1]).toBe("2-1-1.t = 1-1-1.t");
  });

  it("holds at its solution, every equation of it", async () => {
    for (const design of ["figure-8", "residential-house", "apartment-house", "qualifiers-d"]) {
      const system = await systemOf(design);
      const value = (variable: number) => system.solved?.placed[variable] ?? Number.NaN;
      for (const [g] of system.paths.entries())
        for (const own of writtenOut(system, g).constraints) {
          const sides = own.places.map((place) => system.boundsOf(place).map(value));
          if (own.kind === "size") {
            const [here, first] = sides as [number[], number[]];
            expect((here[1] ?? 0) - (here[0] ?? 0), own.text).toBeCloseTo((first[1] ?? 0) - (first[0] ?? 0), 6);
          }
          if (own.kind === "order") expect((sides[0]?.[1] ?? 0) - (sides[0]?.[0] ?? 0), own.text).toBeGreaterThan(0);
        }
    }
  });
});

describe("forces", () => {
  it.each(["residential-house", "apartment-house", "figure-7"])(
    "balance at every boundary, and pull each symbol away from its preferred size: %s",
    async (design) => {
      const system = await systemOf(design);
      const { solved, posed } = system;
      if (!solved) throw new Error("not solved");
      const balance = posed.variables.map((_, v) => solved.multipliers[v] ?? 0);
      for (const [row, variable, value] of posed.entries)
        balance[variable] = (balance[variable] ?? 0) + value * (solved.multipliers[system.count + row] ?? 0);
      const ratios: number[] = [];
      for (const [v, weight] of posed.weight.entries()) {
        const off = (solved.solution[v] ?? 0) - (posed.target[v] ?? 0);
        if (weight === 0) expect(balance[v], posed.variables[v]).toBeCloseTo(0, 6);
        else if (Math.abs(off) > 1e-4) ratios.push(-(balance[v] ?? 0) / off);
      }
      for (const ratio of ratios) expect(ratio).toBeCloseTo(ratios[0] ?? 0, 4);
      expect(ratios.every((ratio) => ratio > 0)).toBe(true);
    },
  );

  it("are drawn inwards in letters that are too long, outwards in those that are too short", async () => {
    one = await show(sizing, "residential-house");
    horizontal();
    const titles = texts(".fnb-forces-letter title");
    expect(titles.find((text) => text.includes(" D:"))).toContain("it is stretched, and pulls");
    const arrows = [...one.view.el.querySelectorAll(".fnb-force[data-kind]")].map((own) =>
      own.getAttribute("data-kind"),
    );
    expect(new Set(arrows)).toEqual(new Set(["pull", "push"]));
    expect(one.view.el.querySelectorAll(".fnb-force-wall").length).toBe(2);
  });

  it("are none where every symbol has its size", async () => {
    one = await show(sizing, "figure-8");
    horizontal();
    expect(one.view.el.querySelectorAll(".fnb-force").length).toBe(0);
    expect(texts("figcaption")[0]).toContain("No forces");
  });
});

describe("sizing, step by step", () => {
  it("is posed, then solved, then done", async () => {
    one = await show(sizing, "residential-house");
    const kinds = one.timeline.data.kinds;
    const at = (kind: string) => one.timeline.data.kind.findIndex((n) => kinds[n] === kind);
    one.go(at("SystemPosed") - 1);
    expect(one.view.el.textContent).toContain("not posed yet");
    one.go(at("SystemPosed"));
    expect(texts(".fnb-size-sum")[0]).toContain("Posed; nothing is solved yet");
    expect(one.view.el.querySelectorAll("[data-active]").length).toBe(0);
    one.go(at("ActiveSetStep"));
    expect(texts(".fnb-size-sum")[0]).toContain("Round 1 (sizes), step 0: 19 active");
    expect(texts("tfoot td").at(-1)).toBe("0.01976");
    one.go(at("SystemSolved"));
    expect(texts(".fnb-size-sum")[0]).toContain("deviation √Σ(size − preferred)² = 0.141 m");
  });

  it("shows the rows that are asked for", async () => {
    one = await show(sizing, "residential-house");
    horizontal();
    tab("Bx = d");
    expect(one.view.el.querySelectorAll('.fnb-rows [data-kind="inequality"]').length).toBe(0);
    tab("Cx ≤ e");
    expect(one.view.el.querySelectorAll('.fnb-rows [data-kind="equation"]').length).toBe(0);
    expect(texts(".fnb-size-text")).toContain("default: x0 < x1");
    tab("written out");
    expect(texts(".fnb-size-min li")).toContain("(1-4-1.t − 1-4-1.s − 1.1)²");
  });

  it("draws its matrix: an entry where the system has one, with its sign", async () => {
    one = await show(sizing, "figure-8");
    horizontal();
    const [row] = one.view.el.querySelectorAll(".fnb-rows .fnb-size-row");
    const cells = [...(row?.querySelectorAll<HTMLElement>(".fnb-size-cell") ?? [])].map((cell) => [
      cell.textContent,
      cell.title,
    ]);
    expect(cells).toEqual([
      ["−1", "−1 · x0"],
      ["1", "1 · x1"],
      ["−1", "−1 · |C|"],
    ]);
  });

  it("lights rows with their letters, symbols and boundaries", async () => {
    one = await show(sizing, "figure-8");
    horizontal();
    const lit = () => texts(".fnb-rows .fnb-size-row[data-lit] .fnb-size-text");
    one.links.hover([target.letter("x", "corners", 0)]);
    one.links.apply(one.view.el);
    expect(lit()).toEqual(["1-1-1.t − 1-1-1.s = |C|"]);
    expect(one.view.el.querySelectorAll(".fnb-forces-letter[data-lit]").length).toBe(1);
    one.links.hover([target.symbol("B")]);
    one.links.apply(one.view.el);
    expect(lit()).toEqual(["2-2-1.t − 2-2-1.s = |B|", "2-4-1.t − 2-4-1.s = |B|", "0.001 ≤ |B|"]);
  });
});

describe("sizes are predicted", () => {
  const posed = async (design: string, name: string) => {
    one = await show(sizing, design);
    horizontal();
    const quiz = one.view.quiz;
    if (!quiz) throw new Error("no quiz");
    quiz.ask(true);
    quiz.pose(name);
    one.go(one.player.position);
    return quiz;
  };

  it("asks which symbols grow, with nothing solved in sight", async () => {
    const quiz = await posed("residential-house", "sizes");
    expect(quiz.prompt).toBe("Which symbols end larger than they like? Tick them.");
    expect(one.view.el.querySelectorAll(".fnb-forces-letter, .fnb-force, .fnb-size-table").length).toBe(0);
    const { posed: told, solved } = await systemOf("residential-house");
    const larger = told.meaning.flatMap(({ kind, symbol }, v) =>
      kind === "size" && (told.weight[v] ?? 0) > 0 && (solved?.solution[v] ?? 0) > (told.target[v] ?? 0) + 1e-6
        ? [symbol]
        : [],
    );
    expect(larger.length).toBeGreaterThan(0);
    expect(larger.length).toBeLessThan(quiz.truths.size);
    for (const symbol of larger) quiz.choose(symbol);
    expect(quiz.check()).toEqual({ right: larger, wrong: [], missed: [] });
    one.go(one.player.position);
    expect(texts(".fnb-offer-why").join()).toMatch(/✓ \|\w+\| likes [\d.]+ m and gets [\d.]+ m: [\d.]+ m more\./);
    expect(one.view.el.querySelectorAll(".fnb-force").length).toBeGreaterThan(0);
  });

  it("asks for the equation of a letter that is marked, among others that do not hold for it", async () => {
    const quiz = await posed("figure-8", "an equation");
    const system = await systemOf("figure-8");
    const rows = new Set(system.constraints.map(({ text }) => text));
    for (let round = 0; round < 4; round++) {
      expect(one.view.el.querySelectorAll(".fnb-forces-letter[data-marked]").length).toBeGreaterThan(0);
      const [, symbol, ijk] = /letter (\w+) \(([\d-]+)\)/.exec(quiz.prompt) ?? [];
      const right = [...quiz.truths].filter(([, truth]) => truth.right).map(([text]) => text);
      expect(right).toHaveLength(1);
      expect(rows.has(right[0] ?? "")).toBe(true);
      expect(right[0]).toContain(`${ijk}.t − ${ijk}.s`);
      expect(right[0]?.endsWith(`= |${symbol}|`)).toBe(true);
      expect(quiz.truths.size).toBeGreaterThanOrEqual(3);
      quiz.again();
      one.go(one.player.position);
    }
  });

  it("says of a cut letter that only its pieces together have its size", async () => {
    const quiz = await posed("figure-8", "an equation");
    while (!quiz.prompt.includes("letter e ")) quiz.again();
    one.go(one.player.position);
    quiz.choose("1-2-1.t − 1-2-1.s = |e|");
    quiz.help();
    quiz.check();
    expect(quiz.outcome()).toBe("No. e is cut: only its pieces together are as long as e.");
  });

  it("does not ask which constraint is next where all become active at once", async () => {
    expect((await posed("residential-house", "sizes")).names).toEqual(["sizes", "an equation"]);
  });

  it("asks which constraint becomes active next, by what is broken most", async () => {
    const { posed: told, paths } = await systemOf("figure-8");
    const inequality = told.rows.findIndex((_, row) => {
      const number = told.variables.length + row;
      return told.lower[number] !== told.upper[number];
    });
    const number = told.variables.length + inequality;
    const step = {
      event: "ActiveSetStep" as const,
      axis: "x" as const,
      round: 1,
      left: [],
      objective: 0,
      violation: 0,
    };
    const values = told.variables.map(() => 0);
    const all = told.variables.length + told.rows.length;
    const others = Array.from({ length: all }, (_, n) => n).filter(
      (n) => n !== number && told.lower[n] === told.upper[n],
    );
    const events: SizingEvent[] = [
      told,
      { ...step, at: told.at + 1, step: 0, entered: others, active: others.length, values },
      { ...step, at: told.at + 2, step: 1, entered: [number], active: others.length + 1, values },
    ];
    const asked = entering(new System(told, events, paths), told.at + 1);
    expect(asked?.step.step).toBe(1);
    const right = [...(asked?.truths ?? [])].filter(([, truth]) => truth.right);
    expect(right).toHaveLength(1);
    expect(right[0]?.[1].why).toContain("It is broken by");
    expect(entering(new System(told, events.slice(0, 2), paths), told.at)).toBeNull();
  });
});
