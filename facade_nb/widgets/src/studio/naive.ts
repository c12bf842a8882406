// The paper's Figure 3: words side by side at their preferred sizes, with what is wrong there, and a slider to the layout.

import { h, mark, setText, svg } from "../shared/dom.ts";
import { boxOf, type Drawing } from "../shared/drawing.ts";
import type { Flaw, Rect, StageState } from "../shared/stage.ts";
import { rectOf, type Sheet } from "./marks.ts";

const KINDS: Record<Flaw["kind"], [one: string, many: string]> = {
  misalignment: ["boundary apart", "boundaries apart"],
  placement: ["placed unevenly", "placed unevenly"],
  sizing: ["cut by the canvas", "cut by the canvas"],
  occlusion: ["place covered", "places covered"],
  hole: ["hole", "holes"],
  beyond: ["word too long", "words too long"],
};
/** Flaws that are drawn at most. */
const MOST = 300;

export interface NaiveView {
  /** The slider and what it says. */
  el: HTMLElement;
  /** Where flaws are drawn. */
  flaws: SVGGElement;
  turn(on: boolean): void;
  /** Draw anew: for another layout, or another size. */
  show(sheet: Sheet | null, naive: StageState["naive"]): void;
  readonly on: boolean;
}

/** Between two rectangles: 0 is the first, 1 the second. */
export function between(a: Rect, b: Rect, t: number): Rect {
  return a.map((value, i) => value + ((b[i] ?? value) - value) * t) as Rect;
}

/** The transform that brings a shape's drawing from where it was drawn to another rectangle, in units of the drawing. */
export function transformTo(drawing: Drawing, shape: Element, to: Rect): string {
  const box = boxOf(shape);
  const x = drawing.origin.x + to[0] * drawing.scale;
  const y = drawing.origin.y - to[3] * drawing.scale;
  const width = Math.max(0.01, (to[2] - to[0]) * drawing.scale);
  const height = Math.max(0.01, (to[3] - to[1]) * drawing.scale);
  const [sx, sy] = [width / (box.width || 1), height / (box.height || 1)];
  return `matrix(${sx} 0 0 ${sy} ${x - box.x * sx} ${y - box.y * sy})`;
}

export function naiveView(changed: () => void): NaiveView {
  const slider = h("input", {
    type: "range",
    min: 0,
    max: 100,
    step: 1,
    value: 0,
    "aria-label": "From words laid side by side to the aligned layout",
  });
  const said = h("span", { class: "fnb-naive-said" });
  const el = h(
    "div",
    { class: "fnb-naive", role: "group", "aria-label": "Naive and aligned", hidden: true },
    h("span", {}, "Side by side"),
    slider,
    h("span", {}, "Aligned"),
    said,
  );
  const flaws = svg("g", { class: "fnb-flaws" });
  let on = false;
  let shown: { sheet: Sheet; naive: StageState["naive"] } | null = null;

  const draw = () => {
    const t = Number(slider.value) / 100;
    flaws.replaceChildren();
    if (!shown) return;
    const { sheet, naive } = shown;
    const own = sheet.drawing.svg;
    const moves = on && t < 1 && naive.shapes !== undefined;
    mark(own, "data-naive", moves);
    // What is picked is outlined where it is aligned.
    if (flaws.ownerSVGElement) mark(flaws.ownerSVGElement, "data-naive", moves);
    for (const shape of own.querySelectorAll<SVGGElement>("[data-shape]")) {
      const from = moves ? naive.shapes?.[Number(shape.dataset.shape)] : undefined;
      if (!from) {
        shape.removeAttribute("transform");
        continue;
      }
      const box = boxOf(shape);
      const { origin, scale } = sheet.drawing;
      const aligned: Rect = [
        (box.x - origin.x) / scale,
        (origin.y - box.y - box.height) / scale,
        (box.x + box.width - origin.x) / scale,
        (origin.y - box.y) / scale,
      ];
      shape.setAttribute("transform", transformTo(sheet.drawing, shape, between(from, aligned, t)));
    }
    if (!on) return;
    const all = naive.flaws ?? [];
    if (t === 0)
      flaws.replaceChildren(
        ...all.slice(0, MOST).map((flaw) => {
          const rect = rectOf(sheet, flaw.rect);
          rect.setAttribute("class", `fnb-flaw fnb-flaw-${flaw.kind}`);
          rect.append(svg("title", {}, flaw.text));
          return rect;
        }),
      );
    setText(said, naive.shapes ? summary(all, t) : "…");
  };
  slider.addEventListener("input", draw);
  return {
    el,
    flaws,
    turn(to) {
      on = to;
      el.hidden = !to;
      if (to) slider.value = "0";
      draw();
      changed();
    },
    show(sheet, naive) {
      shown = sheet ? { sheet, naive } : null;
      draw();
    },
    get on() {
      return on;
    },
  };
}

/** What is wrong, counted by kind; at the other end nothing is. */
export function summary(flaws: Flaw[], t: number): string {
  if (t === 1) return "Aligned: as it is solved";
  if (flaws.length === 0) return "Nothing is wrong side by side";
  const counts = new Map<Flaw["kind"], number>();
  for (const { kind } of flaws) counts.set(kind, (counts.get(kind) ?? 0) + 1);
  return [...counts].map(([kind, count]) => `${count} ${KINDS[kind][count === 1 ? 0 : 1]}`).join(", ");
}
