// What is drawn over the façade: alignment grid, letters, transparent letters, groups, dimension chains, the survey. All of
// it is made here from numbers, so that switching one on or off asks for no new picture.

import { h, svg } from "../shared/dom.ts";
import { type Box, boxOf, type Drawing } from "../shared/drawing.ts";
import type { MarkedGroup, Marks, Rect } from "../shared/stage.ts";
import { AXES, type Axis, type LayerState } from "../shared/types.ts";

export const VIEWS = {
  grid: "Alignment grid",
  letters: "Letters on cells",
  transparent: "Transparent letters",
  groups: "Groups",
  dimensions: "Dimension chains",
  holes: "Holes",
  survey: "Survey",
} as const;
export type ViewOption = keyof typeof VIEWS;

/** What can only be drawn with the marks. */
export const NEEDS_MARKS: readonly ViewOption[] = ["grid", "transparent", "groups", "dimensions"];

/** So many of a kind are drawn at most: more could not be told apart. */
const MOST = 1500;
const ROOM = 9;

export interface Sheet {
  drawing: Drawing;
  canvas: { width: number; height: number };
  /** Pixels of the screen to a unit of the drawing. */
  scale: number;
}

/** A point of the façade, in units of the drawing. */
const at = ({ drawing: { origin, scale } }: Sheet, x: number, y: number) =>
  [origin.x + x * scale, origin.y - y * scale] as const;

export function rectOf(sheet: Sheet, [left, bottom, right, top]: Rect): SVGRectElement {
  const [x, y] = at(sheet, left, top);
  const { scale } = sheet.drawing;
  return svg("rect", { x, y, width: (right - left) * scale, height: (top - bottom) * scale });
}

function text(x: number, y: number, size: number, words: string, className: string): SVGTextElement {
  return svg("text", { x, y, class: className, "font-size": size, "text-anchor": "middle", dy: "0.35em" }, words);
}

/** The hue of a group, by its place among all. */
export function hueOf(names: string[], name: string): number {
  return Math.max(0, names.indexOf(name)) % 8;
}

/** Boundaries of every group's columns, across the façade. */
export function gridOf(sheet: Sheet, marks: Marks, groups: string[]): SVGElement[] {
  return AXES.flatMap((axis) =>
    (marks[axis] ?? []).map(({ group, columns }) => {
      const d = columns.map((stop) => {
        const [a, b] =
          axis === "x"
            ? [at(sheet, stop, 0), at(sheet, stop, sheet.canvas.height)]
            : [at(sheet, 0, stop), at(sheet, sheet.canvas.width, stop)];
        return `M${a[0]} ${a[1]}L${b[0]} ${b[1]}`;
      });
      return svg("path", { d: d.join(""), class: `fnb-mark-grid fnb-hue-${hueOf(groups, group)}` });
    }),
  );
}

/** The two symbols of each cell, where there is room for them. */
export function lettersOf(sheet: Sheet, shapes: Element[], colour: (symbol: string) => string): SVGElement[] {
  const boxes = shapes.slice(0, MOST).map(boxOf);
  // Where a shape of a higher layer stands in the middle, the letters are its.
  const hidden = (box: Box, i: number) => {
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    return boxes.some((own, k) => k > i && x > own.x && x < own.x + own.width && y > own.y && y < own.y + own.height);
  };
  return boxes.flatMap((box, i) => {
    const shape = shapes[i];
    if (!shape || hidden(box, i)) return [];
    const words = `${shape.getAttribute("data-x")} ${shape.getAttribute("data-y")}`;
    const size = Math.min(13 / sheet.scale, box.height * 0.6, box.width / (0.62 * words.length));
    if (size * sheet.scale < 5) return [];
    const drawn = text(box.x + box.width / 2, box.y + box.height / 2, size, "", "fnb-mark-letter");
    drawn.append(...lettered(shape.getAttribute("data-x") ?? "", shape.getAttribute("data-y") ?? "", colour));
    return [drawn];
  });
}

/** The two letters of a cell, each in its symbol's colour. */
function lettered(x: string, y: string, colour: (symbol: string) => string): SVGElement[] {
  const span = (symbol: string, words: string) => {
    const drawn = svg("tspan", {}, words);
    drawn.style.setProperty("--fnb-tint", colour(symbol));
    return drawn;
  };
  return [span(x, `${x} `), span(y, y)];
}

/** Cells that a transparent letter leaves free: dashed, each with its letter. */
export function transparentOf(sheet: Sheet, marks: Marks): SVGElement[] {
  const rows = (axis: Axis) =>
    new Map((marks[axis] ?? []).flatMap((group) => group.rows.map((row) => [row.layer, row.letters] as const)));
  const [across, up] = [rows("x"), rows("y")];
  const drawn: SVGElement[] = [];
  for (const [layer, columns] of across)
    for (const [x, left, right, clearX] of columns)
      for (const [y, bottom, top, clearY] of up.get(layer) ?? []) {
        if (!(clearX || clearY) || drawn.length >= MOST) continue;
        const cell = rectOf(sheet, [left, bottom, right, top]);
        cell.setAttribute("class", "fnb-mark-clear");
        drawn.push(cell);
        const words = clearX && clearY ? `${x} ${y}` : clearX ? x : y;
        // In the upper part of the cell: in its middle other layers write theirs.
        const [cx, cy] = at(sheet, (left + right) / 2, bottom + 0.82 * (top - bottom));
        const size = Math.min(11 / sheet.scale, ((right - left) * sheet.drawing.scale) / (0.7 * words.length));
        if (size * sheet.scale >= 5) drawn.push(text(cx, cy, size, words, "fnb-mark-clear-letter"));
      }
  return drawn;
}

/** Each cell tinted by its layer's group across, and outlined by its group upwards. */
export function groupsOf(shapes: Element[], layers: LayerState[], groups: string[]): SVGElement[] {
  const byName = new Map(layers.map((layer) => [layer.name, layer]));
  return shapes.flatMap((shape) => {
    const layer = byName.get(shape.getAttribute("data-layer") ?? "");
    if (!layer) return [];
    const { x, y, width, height } = boxOf(shape);
    const tint = svg("rect", { x, y, width, height, class: `fnb-mark-group fnb-hue-${hueOf(groups, layer.x.group)}` });
    const line = svg("rect", {
      x,
      y,
      width,
      height,
      class: `fnb-mark-group-line fnb-hue-${hueOf(groups, layer.y.group)}`,
    });
    return [tint, line];
  });
}

/** Which colour is which group's, for those that are in use. */
export function legendOf(groups: string[], used: string[]): HTMLElement[] {
  return used.map((group) => h("span", { class: `fnb-mark-key fnb-hue-${hueOf(groups, group)}` }, group));
}

/** Chains of dimensions at the foot and at the left: columns where there is room for their figures, then the whole. */
export function dimensionsOf(sheet: Sheet, marks: Marks): SVGElement[] {
  return AXES.flatMap((axis) => chainOf(sheet, axis, marks[axis] ?? []));
}

function chainOf(sheet: Sheet, axis: Axis, groups: MarkedGroup[]): SVGElement[] {
  const whole = axis === "x" ? sheet.canvas.width : sheet.canvas.height;
  const stops = [...new Set([0, whole, ...groups.flatMap((group) => group.columns)])].sort((a, b) => a - b);
  const inner = stops.filter((stop, i) => i === 0 || stop - (stops[i - 1] ?? 0) > 1e-4);
  const unit = 1 / sheet.scale;
  const d: string[] = [];
  const drawn: SVGElement[] = [];
  for (const [level, chain] of [inner, [0, whole]].entries()) {
    if (level === 1 && inner.length === 2) continue;
    const off = (16 + 15 * level) * unit;
    const place = (stop: number) => {
      const [x, y] = at(sheet, axis === "x" ? stop : 0, axis === "x" ? 0 : stop);
      return axis === "x" ? [x, y + off] : [x - off, y];
    };
    const ends = chain.map(place) as [number, number][];
    const [first, last] = [ends[0], ends.at(-1)];
    if (!first || !last) continue;
    d.push(`M${first[0]} ${first[1]}L${last[0]} ${last[1]}`);
    for (const [x, y] of ends) d.push(`M${x - 3 * unit} ${y + 3 * unit}l${6 * unit} ${-6 * unit}`);
    for (let i = 1; i < chain.length; i++) {
      const [a, b] = [ends[i - 1], ends[i]];
      const size = (chain[i] ?? 0) - (chain[i - 1] ?? 0);
      const words = size.toFixed(2);
      if (!a || !b || Math.hypot(b[0] - a[0], b[1] - a[1]) / unit < words.length * 5.2) continue;
      const [x, y] = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
      const label = text(0, 0, ROOM * unit, words, "fnb-mark-measure");
      const shift = `translate(${axis === "x" ? x : x - 6 * unit} ${axis === "x" ? y - 6 * unit : y})`;
      label.setAttribute("transform", axis === "x" ? shift : `${shift} rotate(-90)`);
      drawn.push(label);
    }
  }
  return [svg("path", { d: d.join(""), class: "fnb-mark-chain" }), ...drawn];
}
