import { afterEach, describe, expect, it } from "vitest";
import { target } from "../../src/solver/links.ts";
import { facade } from "../../src/solver/views/facade.ts";
import { eventually } from "../shared/waiting.ts";
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

  it("tells nothing early: what is not built is seen, and lights up, only where a preview is asked for", async () => {
    one = await show(facade, "residential-house");
    one.go(0);
    expect(one.view.el.hasAttribute("data-preview")).toBe(false);
    expect(lit(target.symbol("B"))).toHaveLength(0);
    one.view.controls?.[0]?.click();
    expect(one.view.el.hasAttribute("data-preview")).toBe(true);
    expect(lit(target.symbol("B"))).toHaveLength(5);
  });

  it("of a design without a layout is its canvas, and the reason", async () => {
    one = await show(facade, "contradiction");
    expect(drawn()).toBe(0);
    expect(note()).toBe(one.timeline.data.failure);
    expect(note()).not.toBe("");
  });

  it("has all of a candidate that is longer than the canvas in its picture, and marks the canvas", async () => {
    one = await show(facade, "residential-house");
    const viewBox = () =>
      (one.view.el.querySelector(".fnb-traced-sheet > svg")?.getAttribute("viewBox") ?? "").split(" ").map(Number);
    const [, , width = 0, height] = viewBox();
    const edge = () => one.view.el.querySelector(".fnb-traced-beyond");
    one.links.pick([target.candidate("x", 3)]); // (AB)5A, 9 m
    await eventually(() => expect(edge()?.querySelector("text")?.textContent).toBe("canvas 6 m"));
    const boxes = [...one.view.el.querySelectorAll(".fnb-traced-other [data-x]")].map((each) => {
      const cell = each.querySelector("rect.cell");
      const [move = 0, by = 1] =
        (each.getAttribute("transform") ?? "").match(/[\d.-]+/g)?.flatMap((n, k) => (k % 2 ? [] : [Number(n)])) ?? [];
      return move + by * (Number(cell?.getAttribute("x")) + Number(cell?.getAttribute("width")));
    });
    const right = Math.max(...boxes);
    expect(right).toBeGreaterThan(width);
    expect(viewBox()[2]).toBeGreaterThan(right);
    const canvas = one.view.el.querySelector(".fnb-traced-canvas");
    const end = Number(canvas?.getAttribute("x")) + Number(canvas?.getAttribute("width"));
    expect(Number(edge()?.querySelector("line")?.getAttribute("x1"))).toBeCloseTo(end);
    expect(note()).toMatch(/ They reach 3 m beyond the canvas\.$/);
    one.links.pick([]);
    expect(viewBox()).toEqual([0, 0, width, height]);
    expect(edge()?.children).toHaveLength(0);
    // One that is shorter needs no more room.
    one.links.pick([target.candidate("x", 4)]);
    await eventually(() => expect(note()).toContain("not the layout"));
    expect(viewBox()).toEqual([0, 0, width, height]);
    expect(note()).not.toContain("beyond");
  });

  it("draws a candidate's shapes with all their parts, also where those of the layout are behind others", async () => {
    one = await show(facade, "apartment-house");
    const windows = (root: string) => [
      ...one.view.el.querySelectorAll(`${root} [data-layer=base][data-x=B][data-y=W]`),
    ];
    const plain = (all: Element[]) => all.filter((each) => !each.querySelector("use")).length;
    expect(plain(windows("svg"))).toBe(7); // the first floor's stand behind its own layers
    one.links.pick([target.candidate("y", 3)]);
    await eventually(() => expect(windows(".fnb-traced-other").length).toBeGreaterThan(7));
    expect(plain(windows(".fnb-traced-other"))).toBe(0);
  });

  describe("under the forces of the sizing", () => {
    const loads = (): Element[] => [...one.view.el.querySelectorAll(".fnb-loads .fnb-load")];
    const kinds = (): (string | null)[] => loads().map((each) => each.getAttribute("data-kind"));
    const legend = (): string => one.view.el.querySelector(".fnb-legend:not([hidden])")?.textContent ?? "";
    const choose = (label: string) =>
      one.view.controls?.[1]?.querySelector<HTMLElement>(`[aria-label="${label}"]`)?.click();
    const at = (kind: string): number =>
      [...one.timeline.data.kind].findIndex((_, n) => one.timeline.kindAt(n) === kind);

    it("shows what is stretched, what is squeezed, and the canvas that holds it, once the system is solved", async () => {
      one = await show(facade, "residential-house");
      expect(loads()).toHaveLength(0);
      expect(legend()).toBe("");
      const solved = at("SystemSolved");
      one.go(solved - 1);
      expect(loads()).toHaveLength(0);
      expect(legend()).toBe("The forces along x are known when its system is solved.");
      one.go(solved);
      // The door; A B A before the squeezed B in the middle, and after it; both ends of the canvas.
      expect(kinds()).toEqual(["pull", "pull", "push", "pull", "hold", "hold"]);
      expect(legend()).toBe("Forces along xstretched, pullssqueezed, pushesheld by the canvaslargest 0.18 m² per m");
      const titles = [...one.view.el.querySelectorAll(".fnb-load-letter title")].map((each) => each.textContent);
      expect(titles).toHaveLength(8);
      expect(titles[0]).toMatch(/^1-4-1 D, 1\.19 m: it is stretched, and pulls with 0\.18 m² per m$/);
      one.go(one.timeline.last);
      expect(loads()).toHaveLength(0);
      choose("Show the forces of the horizontal axis");
      expect(kinds()).toHaveLength(6);
      choose("Show no forces");
      expect([loads().length, legend()]).toEqual([0, ""]);
      choose("Show the forces of the vertical axis");
      expect(legend()).toBe("No forces along y: every symbol has the size that it likes.");
    });

    it("passes a force on from letter to letter, and its arrows are as long as it is large", async () => {
      one = await show(facade, "apartment-house");
      choose("Show the forces of the vertical axis");
      const letters = one.view.el.querySelectorAll(".fnb-load-letter");
      expect(letters).toHaveLength(8);
      expect(kinds()).toEqual(["pull", "pull", "hold", "hold"]);
      choose("Show the forces of the horizontal axis");
      /** Units from the first point of an arrow to its tip, and which way. */
      const long = (each: Element): number => {
        const [from = 0, to = 0] = [
          ...(each.querySelector(".fnb-load-arrow")?.getAttribute("d") ?? "").matchAll(/[ML]([\d.-]+) /g),
        ].map(([, x]) => Number(x));
        return to - from;
      };
      const [first, last] = [loads().filter((each) => each.getAttribute("data-kind") === "hold")[0], loads()[0]];
      expect(long(last as Element) / long(first as Element)).toBeCloseTo(-1, 1); // 0.0117 both: the canvas holds it
    });

    it("lights up with the equation, and is not shown while a view asks, or of a candidate", async () => {
      one = await show(facade, "residential-house");
      choose("Show the forces of the horizontal axis");
      const row = one.view.el.querySelector(".fnb-load-letter")?.getAttribute("data-link")?.split(" ")[0] ?? "";
      expect(row).toBe(target.row("x", "1:0-3-0 = |D|"));
      one.links.hover([row]);
      one.view.light?.();
      expect(one.view.el.querySelectorAll(".fnb-load-letter[data-lit]")).toHaveLength(1);
      one.asking.set(one, 5);
      one.go(one.player.position);
      expect([loads().length, legend()]).toEqual([0, "Forces are not shown while a view asks."]);
      one.asking.set(one, null);
      one.links.pick([target.candidate("x", 1)]);
      await eventually(() => expect(legend()).toBe("Forces are told of the layout only."));
      expect(loads()).toHaveLength(0);
    });
  });
});
