import { afterEach, describe, expect, it } from "vitest";
import { unpack } from "../../src/shared/packing.ts";
import { choices, columnsOf, cutsOf, merged, moved, split } from "../../src/solver/align/matrix.ts";
import { costOf, nextCases } from "../../src/solver/align/question.ts";
import { latticeOf } from "../../src/solver/lattice.ts";
import { target } from "../../src/solver/links.ts";
import type { PathNote } from "../../src/solver/network/story.ts";
import { alignment } from "../../src/solver/views/alignment.ts";
import { Group, walk, weigh } from "../../src/solver/weights.ts";
import { pieceOf, type Shown, show } from "./fixtures.ts";

let one: Shown;
afterEach(() => one?.end());

const group = (name: string): HTMLElement =>
  one.view.el.querySelector<HTMLElement>(`[data-group="${name}"]`) as HTMLElement;
const texts = (selector: string, within: ParentNode): string[] =>
  [...within.querySelectorAll(selector)].map((element) => (element.textContent ?? "").trim());
const rows = (name: string): string[][] =>
  [...group(name).querySelectorAll(".fnb-align-row")].map((row) => texts(".fnb-box", row as HTMLElement));
const handle = (name: string, label: string): HTMLElement =>
  group(name).querySelector<HTMLElement>(`[aria-label="${label}"]`) as HTMLElement;
const press = (element: HTMLElement, key: string) => element.dispatchEvent(new KeyboardEvent("keydown", { key }));
const pathOf = async (design: string, name: string): Promise<PathNote> => {
  const { paths } = await unpack<{ paths: PathNote[] }>(pieceOf(design, "alignment"));
  return paths.find((path) => path.axis === "x" && path.group === name) as PathNote;
};

describe("the matrix", () => {
  it("of Figure 8 has e cut in three, each column as wide as its letters", async () => {
    one = await show(alignment, "figure-8");
    expect(rows("default")).toEqual([
      ["C", "e1", "e2", "e3", "C"],
      ["A", "B", "A", "B", "A"],
    ]);
    expect(texts(".fnb-align-values:not(.fnb-align-errors) > span", group("default"))).toEqual([
      "2",
      "3",
      "2",
      "3",
      "2",
    ]);
    expect(texts(".fnb-align-errors > span", group("default"))).toEqual(["0", "0", "0", "0", "0"]);
    expect(texts(".fnb-align-figure", group("default"))).toEqual(["Ω = 0 m", "W = 12 m", "J = 0 m"]);
    const last = [...group("default").querySelectorAll(".fnb-align-row")].at(-1) as HTMLElement;
    const widths = [...last.querySelectorAll<HTMLElement>(".fnb-box")].map((box) => parseFloat(box.style.width));
    expect((widths.at(-1) ?? 0) / (widths.at(-2) ?? 1)).toBeCloseTo(2 / 3, 4);
  });

  it("adds up to the J of the candidate, over all groups", async () => {
    for (const design of ["apartment-house", "residential-house", "figure-8"]) {
      const { events } = await unpack<{ events: { axis: string; fate: string; cost: number }[] }>(
        pieceOf(design, "candidates"),
      );
      const { paths } = await unpack<{ paths: PathNote[] }>(pieceOf(design, "alignment"));
      const { objective } = await unpack<{ objective: unknown }>(pieceOf(design, "timeline"));
      for (const axis of ["x", "y"]) {
        const best = events.find((own) => own.axis === axis && own.fate === "best");
        const sum = paths
          .filter((path) => path.axis === axis)
          .reduce((all, path) => {
            const group = new Group(path.bands, path.canvas, path.tolerance, objective as never);
            return all + costOf(path, group);
          }, 0);
        expect(sum, `${design} ${axis}`).toBeCloseTo(best?.cost ?? -1, 6);
      }
    }
  });

  it("shows gap letters beside what is not opaque, and ε where a row is empty", async () => {
    one = await show(alignment, "qualifiers-d");
    expect(texts(".fnb-align-gap", group("default")).every((text) => text === "γ")).toBe(true);
    const empty = [...group("default").querySelectorAll('[data-empty=""]')];
    expect(empty.length).toBeGreaterThan(0);
    expect(empty.every((cell) => cell.textContent === "ε")).toBe(true);
  });

  it("comes when the path is chosen, at preferred sizes until letters are placed", async () => {
    one = await show(alignment, "residential-house");
    const at = one.timeline.data.marks.filter((own) => own.kind === "PathChosen").map((own) => own.at);
    one.go((at[0] ?? 0) - 1);
    expect(one.view.el.textContent).toContain("Nothing is aligned yet");
    one.go(at[1] ?? 0);
    expect(group("default").dataset.now).toBe("");
    expect(group("default").querySelector("header")?.textContent).toContain("at preferred sizes");
    expect(texts(".fnb-align-figure", group("default"))).toEqual(["Ω = 0.1 m", "W = 5.6 m", "J = 0.233 m"]);
    one.go(one.timeline.last);
    one.view.controls?.[0]?.querySelectorAll("button")[1]?.click();
    expect(group("default").querySelector("header")?.textContent).toContain("at solved sizes");
  });

  it("names columns and letters as the other views do", async () => {
    one = await show(alignment, "residential-house");
    one.view.controls?.[0]?.querySelectorAll("button")[1]?.click();
    one.links.hover([target.column("x", "default", 3)]);
    one.links.apply(one.view.el);
    expect(texts(".fnb-align-number[data-lit]", one.view.el)).toEqual(["4+"]);
    one.links.hover([target.letter("x", "base", 2)]);
    one.links.apply(one.view.el);
    expect(texts(".fnb-box[data-lit]", one.view.el)).toEqual(["A"]);
  });
});

describe("an alignment tried by hand", () => {
  it("is judged at every step: Ω, W, and what it breaks", async () => {
    one = await show(alignment, "residential-house");
    one.view.controls?.[0]?.querySelectorAll("button")[1]?.click();
    // Row “door” is f D f: its D stands in column 4. Pushed on by its right boundary it takes in a piece of f: C2.
    const before = rows("default");
    press(handle("default", "Boundary 4 of door"), "ArrowRight");
    expect(group("default").dataset.tried).toBe("");
    const broken = group("default").querySelector<HTMLElement>("li[data-constraint]");
    expect(broken?.dataset.constraint).toBe("C2");
    expect(broken?.textContent).toContain("D f of “door” are partly transparent, partly not (C2)");
    expect(texts(".fnb-align-figure", group("default"))[0]).toMatch(/^Ω = .* solver: 0.1$/);
    group("default").querySelector<HTMLElement>(".fnb-align-reset")?.click();
    expect(rows("default")).toEqual(before);
    expect(group("default").querySelector(".fnb-align-fine")).not.toBeNull();
  });

  it("joins columns by Delete and cuts them by their button", async () => {
    one = await show(alignment, "figure-8");
    press(handle("default", "Boundary 2 of all rows"), "Delete");
    press(handle("default", "Boundary 2 of all rows"), "Delete");
    expect(rows("default")).toEqual([
      ["C", "e", "C"],
      ["A", "B", "A", "B", "A"],
    ]);
    expect(texts(".fnb-align-figure", group("default"))[0]).toBe("Ω = 0 m solver: 0");
    expect(group("default").querySelector(".fnb-align-fine")).not.toBeNull();
    group("default").querySelector<HTMLElement>('[aria-label="Cut column 2 in two"]')?.click();
    expect(rows("default")[0]).toEqual(["C", "e1", "e2", "C"]);
  });

  it("keeps the focus where it was", async () => {
    one = await show(alignment, "figure-8");
    const own = handle("default", "Boundary 1 of walls");
    own.focus();
    press(own, "ArrowRight");
    expect(document.activeElement?.getAttribute("aria-label")).toBe("Boundary 1 of walls");
    expect(group("default").dataset.tried).toBe("");
    press(document.activeElement as HTMLElement, "ArrowLeft");
    expect(group("default").dataset.tried).toBeUndefined();
  });

  it.each(["residential-house", "apartment-house", "figure-8"])("never loses a letter: %s", async (design) => {
    const path = await pathOf(design, design === "apartment-house" ? "1" : "default");
    let cuts = cutsOf(path);
    let seed = 7;
    const random = (n: number) => {
      seed = (seed * 1103515245 + 12345) % 2147483648;
      return Math.floor((seed / 2147483648) * n);
    };
    for (let n = 0; n < 400; n++) {
      const boundary = 1 + random(Math.max(1, cuts.places.length - 2));
      if (cuts.places.length > 3 && random(12) === 0) cuts = merged(cuts, boundary);
      else if (cuts.places.length < 24 && random(12) === 0) cuts = split(path, cuts, random(cuts.filled.length));
      else if (cuts.places.length > 2) {
        const band = random(path.bands.length);
        const options = choices(path, cuts, boundary, band);
        const place = options[random(options.length)];
        if (place !== undefined) cuts = moved(cuts, boundary, band, place);
      }
      const columns = columnsOf(cuts);
      for (const [b, band] of path.bands.entries()) {
        const read = columns.flatMap((column) => [...(column[b] ?? [])]);
        const once = read.filter((letter, k) => letter !== read[k - 1]);
        expect(once, `step ${n}`).toEqual(band.letters.map((_, letter) => letter));
      }
    }
  });
});

describe("at preferred sizes", () => {
  it("every column is as wide as its largest element, however narrow", async () => {
    one = await show(alignment, "apartment-house");
    one.view.controls?.[0]?.querySelectorAll("button")[1]?.click();
    one.view.controls?.[1]?.querySelectorAll("button")[1]?.click();
    const boxes = [...group("3").querySelectorAll<HTMLElement>(".fnb-align-row .fnb-box")];
    const width = (symbol: string) => parseFloat(boxes.find((box) => box.textContent === symbol)?.style.width ?? "0");
    expect(width("D") / width("B")).toBeCloseTo(0.3 / 1.2, 3);
    const starts = boxes.map((box) => parseFloat(box.style.left));
    const ends = boxes.map((box) => parseFloat(box.style.left) + parseFloat(box.style.width));
    for (const [n, start] of starts.slice(1).entries()) expect(start).toBeCloseTo(ends[n] ?? 0, 2);
  });
});

describe("an alignment is predicted", () => {
  const choose = (text: string) => {
    const item = [...one.view.el.querySelectorAll(".fnb-offers li")].find((own) => own.textContent?.includes(text));
    if (!item) throw new Error(`no offer ${text}`);
    item.querySelector("input")?.dispatchEvent(new Event("change"));
    one.go(one.player.position);
  };
  const again = () => one.go(one.player.position);

  it("asks where the next column ends: those before it are there, the rest is not cut", async () => {
    one = await show(alignment, "figure-8");
    const quiz = one.view.quiz;
    if (!quiz) throw new Error("no quiz");
    one.go(0); // before anything is told
    quiz.ask(true);
    again();
    expect(quiz.names).toEqual(["the next column", "a moved boundary"]);
    const [, column] = /^Where does column (\d+) end\?$/.exec(quiz.prompt) ?? [];
    expect(texts(".fnb-align-number", one.view.el)).toEqual([
      ...Array.from({ length: Number(column) - 1 }, (_, n) => String(n + 1)),
      "?",
    ]);
    expect(one.view.el.querySelector(".fnb-align-values, .fnb-align-figure, [role=slider]")).toBeNull();
    const { columns } = await pathOf("figure-8", "default");
    const right = [...quiz.truths].filter(([, truth]) => truth.right).map(([key]) => key);
    const own = columns[Number(column) - 1];
    expect(own?.omega).toBe(0);
    expect(right).toHaveLength(1);
    expect(quiz.truths.size).toBeGreaterThanOrEqual(3);
    const wrong = [...quiz.truths.keys()].find((key) => key !== right[0]) as string;
    quiz.choose(wrong);
    quiz.choose(right[0] as string); // one of them
    expect(quiz.check()).toEqual({ right, wrong: [], missed: [] });
    again();
    expect(quiz.outcome()).toContain("Right. The solver's: ω = 0 m");
    expect(texts(".fnb-align-number[data-marked]", one.view.el)).toEqual([column]);
    expect(texts(".fnb-align-values.fnb-align-errors > span", one.view.el)).toHaveLength(columns.length);
    const reasons = texts('li[data-verdict="passed"] .fnb-offer-why', one.view.el);
    expect(reasons.every((text) => /C\d|so far J is|more than μ|boundary/.test(text))).toBe(true);
  });

  it.each(["residential-house", "apartment-house", "figure-8", "qualifiers-d"])(
    "never offers a wrong column that would do as well: %s",
    async (design) => {
      one = await show(alignment, design);
      const timeline = await unpack<{ objective: unknown }>(pieceOf(design, "timeline"));
      const { paths } = await unpack<{ paths: PathNote[] }>(pieceOf(design, "alignment"));
      let asked = 0;
      for (const path of paths.filter(({ bands }) => bands.length <= 2)) {
        const group = new Group(path.bands, path.canvas, path.tolerance, timeline.objective as never);
        const lattice = latticeOf(group, { nodes: 20_000, edges: 200_000 });
        const missed = group.objective.fit * Math.abs(path.width - path.canvas);
        for (const { column, offers } of nextCases(path, group)) {
          asked++;
          const steps = walk(group, columnsOf(cutsOf(path))) ?? [];
          const state = JSON.stringify([steps[column]?.state, steps[column]?.owed]);
          for (const offer of offers.values()) {
            if (offer.right) continue;
            const edge = lattice.edges.find(
              ({ source, column: own }) =>
                JSON.stringify([lattice.nodes[source]?.state, lattice.nodes[source]?.owed]) === state &&
                JSON.stringify(own.map(({ letters }) => letters)) === JSON.stringify(offer.column) &&
                own.every(({ target }, b) => ((target & 4) !== 0) === offer.cut[b] || offer.column[b]?.length === 0),
            );
            if (!edge) throw new Error("an offer that is no edge");
            if (edge.refusal) continue;
            // What stands before it and this column cost more than the whole of the solver's.
            const before = steps.slice(0, column).reduce((sum, { options }) => sum + weigh(group, options).cost, 0);
            const whole = path.columns.reduce((sum, own, j) => {
              const options = steps[j]?.options.map((option, b) => ({
                ...option,
                size: option.size ?? (own.sizes[b] ?? []).reduce((all, size) => all + size, 0),
              }));
              return sum + weigh(group, options ?? []).cost;
            }, missed);
            expect(before + edge.cost).toBeGreaterThan(whole);
          }
        }
      }
      expect(asked).toBeGreaterThan(0);
    },
  );

  it("asks what a moved boundary breaks; what it breaks is what the judge says", async () => {
    one = await show(alignment, "residential-house");
    one.view.controls?.[0]?.querySelectorAll("button")[1]?.click();
    const quiz = one.view.quiz;
    if (!quiz) throw new Error("no quiz");
    quiz.ask(true);
    quiz.pose("a moved boundary");
    again();
    expect(quiz.prompt).toMatch(
      /^Group default: In the row “.*” boundary \d+ was moved to the (left|right)\. What does that break\?/,
    );
    expect(one.view.el.querySelectorAll(".fnb-align-cell[data-marked]")).toHaveLength(1);
    expect(one.view.el.querySelector("[data-broken], .fnb-align-values, .fnb-align-broken")).toBeNull();
    const truths = [...quiz.truths];
    expect(truths).toHaveLength(7);
    const broken = truths.filter(([, truth]) => truth.right).map(([key]) => key);
    expect(broken.length).toBeGreaterThan(0);
    choose("C3: ");
    quiz.help();
    const answer = quiz.check();
    again();
    expect(answer.missed.concat(answer.right).sort()).toEqual([...broken].sort());
    const said = new Set(
      [...one.view.el.querySelectorAll<HTMLElement>("li[data-constraint]")].map((own) => own.dataset.constraint),
    );
    expect([...said].sort()).toEqual(broken.filter((kind) => kind !== "width").sort());
    const prompt = quiz.prompt;
    quiz.again();
    again();
    expect(quiz.prompt).not.toBe(prompt); // another boundary each time
    quiz.ask(false);
    again();
    expect(group("default").querySelector("[role=slider]")).not.toBeNull();
  });
});
