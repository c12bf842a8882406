import { afterEach, describe, expect, it } from "vitest";
import { filter } from "../../src/solver/filter.ts";
import { target } from "../../src/solver/links.ts";
import { candidates } from "../../src/solver/views/candidates.ts";
import { words } from "../../src/solver/views/words.ts";
import { type Shown, show } from "./fixtures.ts";

let shown: Shown[] = [];
afterEach(() => {
  for (const one of shown.splice(0)) one.end();
  shown = [];
});
const open = async (design: string): Promise<Shown> => {
  const one = await show(candidates, design);
  shown.push(one);
  return one;
};

const cells = (row: Element): string[] =>
  [...row.querySelectorAll("[role=cell]")].map((cell) => cell.textContent ?? "");
const list = ({ view }: Shown): HTMLElement[] => [...view.el.querySelectorAll<HTMLElement>(".fnb-rows .fnb-candidate")];
const column = (one: Shown, name: string): string[] => {
  const heads = [...one.view.el.querySelectorAll("[role=columnheader]")].map((each) =>
    each.textContent?.replace(/ [▴▾]$/, ""),
  );
  return list(one).map((row) => cells(row)[heads.indexOf(name)] ?? "");
};
const sort = (one: Shown, name: string): void =>
  [...one.view.el.querySelectorAll<HTMLElement>(".fnb-sort")]
    .find((each) => each.textContent?.startsWith(name))
    ?.click();
const type = (one: Shown, text: string): void => {
  const field = one.view.controls?.find((each): each is HTMLInputElement => each instanceof HTMLInputElement);
  if (!field) throw new Error("no filter");
  field.value = text;
  field.dispatchEvent(new Event("input"));
};

describe("the candidates", () => {
  it("stand with fate, J, Ω, deviation, counters and words", async () => {
    const one = await open("residential-house");
    expect(column(one, "fate")).toEqual(["★ best", "· bound", "· bound", "· bound", "· bound"]);
    expect(column(one, "k")).toEqual(["3", "4", "2", "5", "1"]);
    expect(column(one, "J")).toEqual(["0.233", "", "", "", ""]);
    expect(column(one, "Ω")[0]).toBe("0.1");
    expect(column(one, "dev.")[0]).toBe("0.141");
    expect(column(one, "J ≥").map(Number)).toEqual([0.233, 0.325, 0.525, 0.75, 0.95]);
    expect(column(one, "Bx")).toEqual(["(AB)3A", "(AB)4A", "ABABA", "(AB)5A", "ABA"]);
  });

  it("sort by any column, what is not known last", async () => {
    const one = await open("residential-house");
    sort(one, "k");
    expect(column(one, "k")).toEqual(["1", "2", "3", "4", "5"]);
    sort(one, "k");
    expect(column(one, "k")).toEqual(["5", "4", "3", "2", "1"]);
    expect(one.view.el.querySelector('[aria-sort="descending"]')?.textContent).toBe("k ▾");
    sort(one, "J");
    expect(column(one, "k")[0]).toBe("3");
    sort(one, "J");
    expect(column(one, "k")[0]).toBe("3");
  });

  it("say what bars and fates mean, and μ, where it is the same for all", async () => {
    const one = await open("apartment-house");
    const legend = one.view.el.querySelector(".fnb-legend")?.textContent ?? "";
    expect(legend).toContain("μ = 10.5 m for all");
    expect(legend).toContain("boundwas given up: it cannot cost less than the best");
    expect(legend).not.toContain("other axis");
    one.view.quiz?.ask(true);
    one.go(one.player.position);
    expect(one.view.el.querySelector(".fnb-legend")?.textContent).toBe("");
  });

  it("are filtered by text and by numbers", async () => {
    const one = await open("apartment-house");
    expect(one.view.el.querySelector("[role=status]")?.textContent).toBe("504 candidates");
    type(one, "k=7 n=1 J<1");
    expect(column(one, "fate")).toEqual(["☆ tied"]);
    type(one, "best");
    expect(list(one)).toHaveLength(1);
    type(one, "nothing");
    expect(one.view.el.querySelector(".fnb-empty")?.textContent).toBe("No candidate passes the filter.");
  });

  it("come one by one, and the tolerance is shown where it rises", async () => {
    const one = await open("figure-7-paper");
    expect(column(one, "μ")).toEqual(["0.5", "1"]);
    const at = one.timeline.data.chosen.x?.at ?? 0;
    one.go(at);
    expect(list(one).at(-1)?.hasAttribute("data-now")).toBe(true);
    one.go(at - 1);
    expect(column(one, "fate")).not.toContain("★ best");
  });

  it("choosing one shows its words in the other views", async () => {
    const one = await open("residential-house");
    const other = await show(words, "residential-house");
    shown.push(other);
    other.links.pick((list(one)[1]?.dataset.link ?? "").split(" "));
    other.links.apply(other.view.el);
    const picked = [...other.view.el.querySelectorAll(".fnb-word[data-chosen] .fnb-word-text")].map(
      (e) => e.textContent,
    );
    expect(picked).toEqual(["H", "fDf", "CeC", "(AB)4A"]);
    expect(list(one)[1]?.dataset.link?.split(" ")[0]).toBe(target.candidate("x", 1));
  });

  it("can be predicted: the answer does not stand in the page", async () => {
    const one = await open("residential-house");
    const quiz = one.view.quiz;
    quiz?.ask(true);
    one.go(one.player.position);
    expect(column(one, "fate").join("")).toBe("");
    const names = [...one.view.el.querySelectorAll(".fnb-sort")].map((own) => own.textContent);
    expect(names).toContain("J − Ω"); // what is to be added to Ω
    expect(names).not.toContain("J");
    type(one, "best");
    expect(list(one)).toEqual([]); // nothing is found by what is asked for
    type(one, "");
    expect(column(one, "k")).toEqual(["1", "2", "3", "4", "5"]);
    expect(one.view.el.querySelector("[data-fate], [title*='layout.']")).toBeNull();
    const radios = [...one.view.el.querySelectorAll("input[type=radio]")];
    radios[3]?.dispatchEvent(new Event("change"));
    quiz?.help();
    expect(quiz?.check()).toEqual({ right: [], wrong: ["1"], missed: [] });
    one.go(one.player.position);
    const wrong = list(one).find((row) => row.dataset.verdict === "wrong");
    expect(wrong?.querySelector(".fnb-candidate-fate")?.getAttribute("title")).toContain(
      "at least 0.325 m against 0.233 m",
    );
    expect(quiz?.outcome()).toMatch(/^No\. It was not aligned to the end.* 0.325 m against 0.233 m\.$/);
  });
});

describe("a filter", () => {
  const row = { numbers: { J: 0.5, k: 3, J2: null }, texts: ["best", "A B A"] };
  it.each([
    ["", true],
    ["best", true],
    ["BEST k=3", true],
    ["k=3 J<0.5", false],
    ["J≤0,5", true],
    ["J>=0.4 J<=0.6", true],
    ["J2<1", false],
    ["z=3", false],
    ["worst", false],
  ])("%s", (typed, holds) => {
    expect(filter(typed)(row)).toBe(holds);
  });
});
