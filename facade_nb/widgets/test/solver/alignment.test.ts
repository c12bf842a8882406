import { afterEach, describe, expect, it } from "vitest";
import { choices, columnsOf, cutsOf, merged, moved, split } from "../../src/solver/align/matrix.ts";
import { target } from "../../src/solver/links.ts";
import type { PathNote } from "../../src/solver/network/story.ts";
import { unpack } from "../../src/solver/packing.ts";
import { alignment } from "../../src/solver/views/alignment.ts";
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
    expect(texts(".fnb-align-figure", group("default"))).toEqual(["Ω = 0 m", "W = 12 m"]);
    const last = [...group("default").querySelectorAll(".fnb-align-row")].at(-1) as HTMLElement;
    const widths = [...last.querySelectorAll<HTMLElement>(".fnb-box")].map((box) => parseFloat(box.style.width));
    expect((widths.at(-1) ?? 0) / (widths.at(-2) ?? 1)).toBeCloseTo(2 / 3, 4);
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
    expect(texts(".fnb-align-figure", group("default"))).toEqual(["Ω = 0.1 m", "W = 5.6 m"]);
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
    expect(broken?.textContent).toContain("D f of row 0 are partly transparent, partly not (C2)");
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
