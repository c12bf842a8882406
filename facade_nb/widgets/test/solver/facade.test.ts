import { afterEach, describe, expect, it } from "vitest";
import { target } from "../../src/solver/links.ts";
import { facade } from "../../src/solver/views/facade.ts";
import { type Shown, show } from "./fixtures.ts";

let one: Shown;
afterEach(() => one?.end());

const drawn = (): number => one.view.el.querySelectorAll("[data-shape]:not([data-later])").length;
const note = (): string => one.view.el.querySelector(".fnb-traced-note")?.textContent ?? "";
const lit = (...keys: string[]): Element[] => {
  one.links.hover(keys);
  one.view.light?.();
  return [...one.view.el.querySelectorAll(".fnb-traced-lit:not(.fnb-traced-letter, .fnb-traced-column)")];
};

describe("the façade", () => {
  it("is built shape by shape", async () => {
    one = await show(facade, "residential-house");
    const shapes = one.timeline.data.kinds.indexOf("ShapeMerged");
    const at = [...one.timeline.data.kind].flatMap((kind, n) => (kind === shapes ? [n] : []));
    expect(at).toHaveLength(17);
    for (const [n, position] of at.entries()) {
      one.go(position);
      expect(drawn()).toBe(n + 1);
      expect(note()).toBe(`${n + 1} of 17 shapes`);
    }
    one.go((at[0] ?? 0) - 1);
    expect(drawn()).toBe(0);
    expect(one.view.el.querySelectorAll(".fnb-traced-strip").length).toBeGreaterThan(10);
    one.go(0);
    expect(note()).toBe("Nothing is placed yet");
  });

  it("lights up for letters, symbols, words, layers and columns", async () => {
    one = await show(facade, "residential-house");
    expect(lit(target.letter("x", "columns", 0))).toHaveLength(1);
    expect(lit(target.symbol("B"))).toHaveLength(5); // one of six windows is behind the door
    expect(lit(target.layer("columns"))).toHaveLength(2);
    expect(lit(target.word("x", "Bx", "A B A B A B A"))).toHaveLength(13);
    expect(lit(target.word("x", "Bx", "A B A"))).toHaveLength(0);
    one.links.hover([target.column("x", "default", 1)]);
    one.view.light?.();
    expect(one.view.el.querySelectorAll(".fnb-traced-column")).toHaveLength(1);
    expect(lit(target.shape(3))).toHaveLength(1);
    expect(lit()).toHaveLength(0);
  });

  it("without its preview nothing that is not built lights up", async () => {
    one = await show(facade, "residential-house");
    one.go(0);
    expect(lit(target.symbol("B"))).toHaveLength(5);
    one.view.controls?.[0]?.click();
    expect(lit(target.symbol("B"))).toHaveLength(0);
  });

  it("of a design without a layout is its canvas, and the reason", async () => {
    one = await show(facade, "contradiction");
    expect(drawn()).toBe(0);
    expect(note()).toBe(one.timeline.data.failure);
    expect(note()).not.toBe("");
  });
});
