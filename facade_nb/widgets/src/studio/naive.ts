// The paper's Figure 3: words side by side at their preferred sizes, with what is wrong there, and a slider to the layout.

import { h, mark, svg } from "../shared/dom.ts";
import { boxOf, type Drawing, parseDrawing } from "../shared/drawing.ts";
import type { Flaw, Rect, StageState } from "../shared/stage.ts";
import { rectOf, type Sheet } from "./marks.ts";

/** Of one, of many, and what that means; in the order of the legend. */
const KINDS: Record<Flaw["kind"], [one: string, many: string, meaning: string]> = {
  misalignment: [
    "boundary of layers apart",
    "boundaries of layers apart",
    "Extrinsic misalignment: what meets in the aligned layout begins at different places in two layers",
  ],
  intrinsic: [
    "letter apart from its pattern",
    "letters apart from their pattern",
    "Intrinsic misalignment: two layers have the same pattern, and their letters begin at different places",
  ],
  sizing: [
    "unequal size",
    "unequal sizes",
    "Inconsistent sizing: the same symbol is wide here and narrow there, or the canvas's end cuts it",
  ],
  placement: [
    "uneven distance",
    "uneven distances",
    "Inconsistent placement: symbols that should all stand alike do not",
  ],
  occlusion: ["place covered", "places covered", "Occlusion: what must not be covered is"],
  hole: ["hole", "holes", "Holes: nothing covers this place"],
  beyond: ["word too long for the canvas", "words too long for the canvas", "Letters stand beyond the canvas"],
  short: ["word too short for the canvas", "words too short for the canvas", "The canvas is not filled"],
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
  const said = h("div", {
    class: "fnb-naive-said",
    role: "group",
    "aria-label": "What is wrong; press to hide a kind",
  });
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
  let legend = "";
  let height = 0;
  const hidden = new Set<Flaw["kind"]>();
  const behind = behindOf();
  /** Whether shapes stand elsewhere than where they were drawn. */
  let moved = false;

  const draw = () => {
    const t = Number(slider.value) / 100;
    flaws.replaceChildren();
    if (!shown) return;
    const { sheet, naive } = shown;
    const own = sheet.drawing.svg;
    const moves = on && t < 1 && naive.shapes !== undefined;
    behind.draw(sheet.drawing, moves ? naive : {}, t);
    mark(own, "data-naive", moves);
    // What is picked is outlined where it is aligned.
    if (flaws.ownerSVGElement) mark(flaws.ownerSVGElement, "data-naive", moves);
    const shapes = moves || moved ? own.querySelectorAll<SVGGElement>("[data-shape]") : [];
    moved = moves;
    for (const shape of shapes) {
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
        ...all
          .filter((flaw) => !hidden.has(flaw.kind))
          .slice(0, MOST)
          .map((flaw) => {
            const rect = rectOf(sheet, flaw.rect);
            rect.setAttribute("class", `fnb-flaw fnb-flaw-${flaw.kind}`);
            rect.append(svg("title", {}, flaw.text));
            return rect;
          }),
      );
    const text = naive.shapes ? summary(all, t) : "…";
    if (text === legend) return;
    legend = text;
    if (t === 1 || all.length === 0 || !naive.shapes) said.replaceChildren(text);
    else said.replaceChildren(...[...counted(all)].map(([kind, words]) => keyFor(kind, words)));
    if (el.offsetHeight !== height) {
      height = el.offsetHeight; // the drawing keeps clear of it
      changed();
    }
  };
  /** One kind in the legend: how it is drawn, and how many there are; pressed, it is drawn. */
  const keyFor = (kind: Flaw["kind"], words: string) => {
    const swatch = svg("svg", { width: 16, height: 12, "aria-hidden": "true" });
    swatch.append(svg("rect", { x: 1, y: 1, width: 14, height: 10, class: `fnb-flaw fnb-flaw-${kind}` }));
    const key = h(
      "button",
      {
        type: "button",
        class: "fnb-flaw-key",
        title: KINDS[kind][2],
        "aria-pressed": String(!hidden.has(kind)),
        "data-local": true,
      },
      swatch as unknown as HTMLElement,
      words,
    );
    key.addEventListener("click", () => {
      if (!hidden.delete(kind)) hidden.add(kind);
      mark(key, "aria-pressed", String(!hidden.has(kind)));
      draw();
    });
    return key;
  };
  slider.addEventListener("input", draw);
  return {
    el,
    flaws,
    turn(to) {
      on = to;
      el.hidden = !to;
      if (to) slider.value = "0";
      legend = "";
      height = 0;
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
  return [...counted(flaws).values()].join(", ");
}

/** How many there are of each kind that occurs, in words. */
function counted(flaws: Flaw[]): Map<Flaw["kind"], string> {
  const words = new Map<Flaw["kind"], string>();
  for (const kind of Object.keys(KINDS) as Flaw["kind"][]) {
    const count = flaws.filter((flaw) => flaw.kind === kind).length;
    if (count > 0) words.set(kind, `${count} ${KINDS[kind][count === 1 ? 0 : 1]}`);
  }
  return words;
}

/** The shapes that the aligned layout has wholly behind others: they are drawn while it is not yet aligned. */
function behindOf() {
  let source = "";
  let parsed: Drawing | null = null;
  const groups: Element[] = [];
  return {
    draw(drawing: Drawing, naive: StageState["naive"], t: number): void {
      for (const group of groups.splice(0)) group.remove();
      const places = naive.behind ?? [];
      if (!places.length || !naive.drawing) return;
      if (source !== naive.drawing || !parsed) {
        source = naive.drawing;
        parsed = parseDrawing(source);
      }
      const own = [...drawing.svg.querySelectorAll("[data-shape]")];
      const defs = parsed.svg.querySelector("defs")?.cloneNode(true) as Element | undefined;
      if (defs) groups.push(defs);
      if (defs) drawing.svg.prepend(defs);
      for (const shape of parsed.svg.querySelectorAll<SVGGElement>("[data-shape]")) {
        const place = places[Number(shape.dataset.shape)];
        if (!place) continue;
        const group = shape.cloneNode(true) as SVGGElement;
        group.removeAttribute("data-shape"); // it is none of the layout's own
        group.setAttribute("class", "fnb-behind");
        const { origin, scale } = parsed;
        const box = boxOf(shape);
        const aligned: Rect = [
          (box.x - origin.x) / scale,
          (origin.y - box.y - box.height) / scale,
          (box.x + box.width - origin.x) / scale,
          (origin.y - box.y) / scale,
        ];
        group.setAttribute("transform", transformTo(drawing, shape, between(place.rect, aligned, t)));
        const next = own.find((other) => Number((other as SVGElement).dataset.shape) === place.before);
        if (next) next.before(group);
        else own.at(-1)?.after(group);
        groups.push(group);
      }
    },
  };
}
