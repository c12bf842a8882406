// The multipliers of the sizing as forces on the elevation: each letter pulls its ends together or pushes them apart, and the
// canvas holds the outermost ones.

import { h, mark, svg } from "../../shared/dom.ts";
import type { Drawing } from "../../shared/drawing.ts";
import { formatNumber } from "../../shared/fields.ts";
import { linked, target } from "../links.ts";
import type { Placing } from "../placing.ts";
import type { Axis } from "../timeline.ts";
import { isForce, type Moment, type Place, type System } from "./system.ts";

const NEAR = 1e-6;

/** A letter under its force; metres along its axis, and across it. */
export interface Load {
  from: number;
  to: number;
  across: number;
  /** Positive where the letter is stretched, and pulls. */
  force: number;
  /** Its row of the system, and the letters of the layout that it stands for. */
  keys: string[];
  symbol: string;
  title: string;
}

/** What the canvas does to an end of a group, metres. */
export interface Hold {
  at: number;
  across: number;
  force: number;
  title: string;
}

export interface Loads {
  axis: Axis;
  letters: Load[];
  holds: Hold[];
  largest: number;
}

/** What a letter and the canvas do at a moment; null before the system is solved: there are no multipliers. */
export function loadsOf(system: System, moment: Moment, placing: Placing): Loads | null {
  if (!moment.solved) return null;
  const { axis } = system.posed;
  const letters: Load[] = [];
  const holds: Hold[] = [];
  const taken: number[] = [];
  for (const [g, path] of system.paths.entries()) {
    const own: number[] = [];
    for (const [b, band] of path.bands.entries()) {
      const layers = band.rows.map((row) => path.layers[row] ?? "");
      const found: Load[] = [];
      for (const [n, letter] of band.letters.entries()) {
        const places = path.columns.flatMap(({ letters }, column) => {
          const place = letters[b]?.indexOf(n) ?? -1;
          return place < 0 ? [] : [{ group: g, band: b, column, place } satisfies Place];
        });
        const [first, last] = [places[0], places.at(-1)];
        const row = first && system.rowOf(first);
        const force = row ? system.multiplier(row.number, moment) : 0;
        if (!first || !last || !row || !isForce(force)) continue;
        const [from, to] = [system.boundsOf(first)[0], system.boundsOf(last)[1]].map((v) => moment.values[v] ?? 0);
        if (from === undefined || to === undefined) continue;
        const does = force > 0 ? "is stretched, and pulls" : "is squeezed, and pushes";
        found.push({
          from,
          to,
          across: 0,
          force,
          keys: [target.row(axis, row.name), ...system.letterKeys(first)],
          symbol: letter.symbol,
          title: `${system.ijk(first)} ${letter.symbol}, ${formatNumber(to - from)} m: it ${does} with ${figure(force)} m² per m`,
        });
      }
      if (!found.length) continue;
      const across = lineOf(placing, axis, layers, taken);
      taken.push(across);
      own.push(across);
      letters.push(...found.map((load) => ({ ...load, across })));
    }
    if (!own.length) continue;
    const across = own.reduce((sum, value) => sum + value, 0) / own.length;
    for (const [v, meaning] of system.posed.meaning.entries()) {
      if (meaning.kind !== "boundary" || meaning.group !== g) continue;
      const force = system.multiplier(v, moment);
      if (system.posed.lower[v] !== system.posed.upper[v] || !isForce(force)) continue;
      const title = `The canvas holds this end of ${path.group} with ${figure(force)} m² per m`;
      holds.push({ at: moment.values[v] ?? 0, across, force, title });
    }
  }
  const largest = Math.max(1e-12, ...[...letters, ...holds].map(({ force }) => Math.abs(force)));
  return { axis, letters, holds, largest };
}

/** Where across the façade the arrows of a word stand: in the middle of shapes of its layer, away from those of other words. */
function lineOf({ shapes }: Placing, axis: Axis, layers: readonly string[], taken: readonly number[]): number {
  const all = shapes.filter((shape) => layers.includes(shape.layer));
  const middles = all.map(({ rect: [left, bottom, right, top] }) =>
    axis === "x" ? (bottom + top) / 2 : (left + right) / 2,
  );
  const ends = shapes.map(({ rect }) => (axis === "x" ? rect[3] : rect[2]));
  const whole = Math.max(0, ...ends);
  const unique = [...new Set(middles.map((value) => value.toFixed(4)))].map(Number);
  if (!unique.length) unique.push(whole / 2);
  const apart = (value: number) =>
    Math.min(whole / 6, ...taken.map((other) => Math.abs(other - value))) - Math.abs(value - whole / 2) / 1e3;
  return unique.reduce((best, value) => (apart(value) > apart(best) + 1e-9 ? value : best));
}

const LONG = 26; // pixels of the largest force
const SHORT = 7;
const HEAD = 3.2;
const HIT = 14;
const JOINT = 3;

/** Letters of a word, one after the other, under the same force: it is passed on from each to the next. */
export interface Run {
  from: number;
  to: number;
  across: number;
  force: number;
  /** Where one letter ends and the next begins. */
  joints: number[];
}

export function runsOf(letters: readonly Load[]): Run[] {
  const runs: Run[] = [];
  for (const { from, to, across, force } of letters) {
    const last = runs.at(-1);
    const same = last && last.across === across && Math.abs(last.to - from) < NEAR;
    if (last && same && Math.abs(last.force - force) < NEAR * Math.max(1, Math.abs(force))) {
      last.joints.push(from);
      last.to = to;
    } else runs.push({ from, to, across, force, joints: [] });
  }
  return runs;
}

/** A force that was drawn, and what lights it up. */
export interface Drawn {
  el: SVGGElement;
  keys: readonly string[];
}

/**
 * Draw forces: a line along letters that pass the same one on, with an arrow at its ends; and what is hovered of each letter.
 *
 * @param unit units of the drawing to a pixel, about
 */
export function drawLoads(loads: Loads, { scale, origin }: Drawing, unit: number): Drawn[] {
  const { axis, largest } = loads;
  const point = (along: number, across: number, aside = 0): [number, number] =>
    axis === "x"
      ? [origin.x + along * scale, origin.y - across * scale + aside]
      : [origin.x + across * scale + aside, origin.y - along * scale];
  const line = (...points: [number, number][]) => `M${points.map(([x, y]) => `${num(x)} ${num(y)}`).join("L")}`;
  const long = (force: number) => unit * Math.max(SHORT, (LONG * Math.abs(force)) / largest);
  /** An arrow from a place along the axis, so many units on. */
  const arrow = (along: number, across: number, by: number): string => {
    const tip = along + by / scale;
    const head = Math.min(unit * HEAD, Math.abs(by));
    const back = tip - (Math.sign(by) * head) / scale;
    const wing = (way: number) => point(back, across, way * head);
    return line(point(along, across), point(tip, across)) + line(wing(1), point(tip, across), wing(-1));
  };
  const shape = (name: string, kind: string, ...children: SVGElement[]) => {
    const el = svg("g", { class: name, "data-kind": kind });
    el.append(...children);
    return el;
  };
  const runs = runsOf(loads.letters).map(({ from, to, across, force, joints }): Drawn => {
    const size = Math.min(long(force), Math.max(2 * unit, ((to - from) * scale) / 2 - 1.5 * unit));
    const step = size / scale;
    const arrows =
      force > 0
        ? arrow(from, across, size) + arrow(to, across, -size)
        : arrow(from + step, across, -size) + arrow(to - step, across, size);
    const passed = line(point(from, across), point(to, across));
    const ticks = joints.map((at) => line(point(at, across, -unit * JOINT), point(at, across, unit * JOINT))).join("");
    const el = shape(
      "fnb-load",
      force > 0 ? "pull" : "push",
      svg("path", { class: "fnb-load-under", d: passed + ticks }),
      svg("path", { class: "fnb-load-under", d: arrows, "data-arrow": true }),
      svg("path", { class: "fnb-load-line", d: passed + ticks }),
      svg("path", { class: "fnb-load-arrow", d: arrows }),
    );
    return { el, keys: [] };
  });
  const letters = loads.letters.map(({ from, to, across, force, keys, symbol, title }): Drawn => {
    const half = (unit * HIT) / 2;
    const [x0, y0] = point(from, across);
    const [x1, y1] = point(to, across);
    const box =
      axis === "x"
        ? { x: x0, y: y0 - half, width: x1 - x0, height: 2 * half }
        : { x: x0 - half, y: y1, width: 2 * half, height: y0 - y1 };
    const hit = svg("rect", { class: "fnb-load-hit", ...box });
    const el = shape("fnb-load-letter", force > 0 ? "pull" : "push", svg("title", {}, title), hit);
    for (const [name, value] of Object.entries(linked(keys, [target.symbol(symbol)]))) mark(el, name, value);
    return { el, keys: [...keys, target.symbol(symbol)] };
  });
  const holds = loads.holds.map(({ at, across, force, title }): Drawn => {
    // The multiplier is positive where the upper bound holds a boundary back.
    const size = -Math.sign(force) * long(force);
    const inwards = at <= 0 === size > 0;
    const d = arrow(inwards ? at - size / scale : at, across, size);
    const [cx, cy] = point(at, across);
    const el = shape(
      "fnb-load",
      "hold",
      svg("title", {}, title),
      svg("path", { class: "fnb-load-under", d, "data-arrow": true }),
      svg("path", { class: "fnb-load-arrow", d }),
      svg("circle", { class: "fnb-load-hit", cx, cy, r: unit * HIT }),
    );
    return { el, keys: [] };
  });
  return [...runs, ...letters, ...holds];
}

/** A multiplier in three figures: some are very small. */
const figure = (force: number): string => String(Number(Math.abs(force).toPrecision(3)));
const num = (value: number): string => value.toFixed(2);

/** What the arrows mean, and how long the longest is. */
export function loadLegend({ axis, letters, holds, largest }: Loads): Node[] {
  if (!letters.length) return [h("span", {}, `No forces along ${axis}: every symbol has the size that it likes.`)];
  const key = (kind: string, ways: readonly [number, number]) => {
    const el = svg("svg", { class: "fnb-load-key", viewBox: "0 0 34 10", "aria-hidden": "true" });
    const g = svg("g", { class: "fnb-load", "data-kind": kind });
    const d = ways.map((way, n) => {
      const tip = way > 0 ? [14, 33][n] : [1, 20][n];
      return `M${(tip ?? 0) - way * 13} 5H${tip}m${-way * 3.2} -3.2l${way * 3.2} 3.2l${-way * 3.2} 3.2`;
    });
    g.append(svg("path", { class: "fnb-load-arrow", d: d.join("") }));
    el.append(g);
    return el as never as Node;
  };
  const item = (is: boolean, kind: string, ways: readonly [number, number], text: string) =>
    is ? [h("span", {}, key(kind, ways), text)] : [];
  const outwards = holds.some(({ at, force }) => at <= 0 === force > 0);
  return [
    h("b", {}, `Forces along ${axis}`),
    ...item(
      letters.some(({ force }) => force > 0),
      "pull",
      [1, -1],
      "stretched, pulls",
    ),
    ...item(
      letters.some(({ force }) => force < 0),
      "push",
      [-1, 1],
      "squeezed, pushes",
    ),
    ...item(holds.length > 0, "hold", outwards ? [-1, 1] : [1, -1], "held by the canvas"),
    h(
      "span",
      { title: "A multiplier: by how much the objective, m², would change for each metre that its equation gives way" },
      `largest ${figure(largest)} m² per m`,
    ),
  ];
}
