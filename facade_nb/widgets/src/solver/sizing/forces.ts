// The façade under its forces: every word before sizing and at the moment, and how each letter pushes or pulls.

import { h, svg } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { hueOf, type LetterNote } from "../letters.ts";
import { linked, target } from "../links.ts";
import { isForce, type Moment, type Place, type System } from "./system.ts";

const WIDE = 900; // pixels, where it is not known
const LEFT = 124;
const RIGHT = 8;
const BEFORE = 9;
const AFTER = 26;
const GAP = 12;
const ARROW = 34; // pixels of the largest force

export interface HowDrawn {
  /** Only the words at preferred sizes. */
  before?: boolean;
  /** A letter that is pointed out, and no forces. */
  marked?: Place;
  /** Pixels. */
  width?: number;
}

export function forces(
  system: System,
  moment: Moment,
  symbols: Record<string, number>,
  { before = false, marked, width: wide = WIDE }: HowDrawn = {},
): HTMLElement {
  const { posed, paths } = system;
  const high = before ? AFTER : BEFORE;
  const canvas = paths[0]?.canvas ?? 1;
  const scale = (wide - LEFT - RIGHT) / canvas / 1.04;
  const x = (value: number) => LEFT + value * scale;
  const all = posed.rows.map((_, row) => Math.abs(system.multiplier(system.count + row, moment)));
  const bounds = posed.variables.map((_, v) => Math.abs(system.multiplier(v, moment)));
  const largest = Math.max(1e-12, ...all, ...bounds);
  const drawing = svg("svg", {
    class: "fnb-forces",
    role: "img",
    "aria-label": "Words before and after sizing, and the forces on them",
  });
  let y = 14;
  for (const [g, path] of paths.entries()) {
    const top = y;
    if (paths.length > 1) {
      drawing.append(svg("text", { class: "fnb-forces-group", x: 4, y: y + 4 }, `Group ${path.group}`));
      y += 12;
    }
    for (const [b, band] of path.bands.entries()) {
      const layer = path.layers[band.rows[0] ?? 0] ?? "";
      const label = svg(
        "text",
        { class: "fnb-forces-layer", x: LEFT - 10, y: y + (before ? 17 : BEFORE + 18) },
        layer.length > 19 ? `${layer.slice(0, 18)}…` : layer,
      );
      drawing.append(label);
      let at = 0;
      for (const [n, letter] of band.letters.entries()) {
        const size =
          letter.size ??
          path.columns.reduce((sum, own) => sum + (own.sizes[b]?.[own.letters[b]?.indexOf(n) ?? -1] ?? 0), 0);
        const keys = band.rows.map((row) => target.letter(path.axis, path.layers[row] ?? "", n));
        drawing.append(
          svg("rect", {
            class: `fnb-forces-before ${hueOf(symbols, letter.symbol)}`,
            x: x(at).toFixed(1),
            y,
            width: Math.max(0.5, size * scale).toFixed(1),
            height: high,
            "data-ghost": letter.transparent,
            "data-large": before,
            ...linked(keys, [target.symbol(letter.symbol)]),
          }),
        );
        if (before && size * scale > 9 * letter.symbol.length) drawing.append(named(letter, x(at + size / 2), y + 17));
        at += size;
      }
      if (before) {
        y += AFTER + GAP;
        continue;
      }
      for (const [column, own] of path.columns.entries())
        for (const [place, n] of (own.letters[b] ?? []).entries()) {
          const letter = band.letters[n];
          const where: Place = { group: g, band: b, column, place };
          const [s, t] = system.boundsOf(where);
          if (!letter || s < 0 || t < 0) continue;
          const [from, to] = [moment.values[s] ?? 0, moment.values[t] ?? 0];
          const row = system.rowOf(where);
          const force = row && !marked ? system.multiplier(row.number, moment) : 0;
          const isMarked = marked && row && row === system.rowOf(marked);
          const long = (to - from) * scale;
          const box = svg("rect", {
            class: `fnb-forces-letter ${hueOf(symbols, letter.symbol)}`,
            x: x(from).toFixed(1),
            y: y + BEFORE + 2,
            width: Math.max(0.5, long).toFixed(1),
            height: AFTER,
            "data-ghost": letter.transparent,
            "data-open": !letter.opaque && !letter.transparent,
            "data-marked": !!isMarked,
            ...linked(system.letterKeys(where), [
              target.symbol(letter.symbol),
              ...(row ? [target.row(posed.axis, row.name)] : []),
            ]),
          });
          const pulls = force > 0 ? "it is stretched, and pulls" : "it is squeezed, and pushes";
          box.append(
            svg(
              "title",
              {},
              `${system.ijk(where)} ${letter.symbol}: ${formatNumber(to - from)} m${isForce(force) ? `; ${pulls}: ${formatNumber(Math.abs(force))}` : ""}`,
            ),
          );
          drawing.append(box);
          if (long > 9 * letter.symbol.length)
            drawing.append(named(letter, (x(from) + x(to)) / 2, y + BEFORE + (marked ? 20 : 12)));
          if (isForce(force)) drawing.append(...arrows(x(from), x(to), y + BEFORE + 21, force, largest));
        }
      y += BEFORE + AFTER + GAP;
    }
    if (!before && !marked) drawing.append(...walls(system, moment, g, x, top, y - GAP, largest));
    y += 6;
  }
  for (const edge of [0, canvas])
    drawing.prepend(svg("line", { class: "fnb-forces-canvas", x1: x(edge), x2: x(edge), y1: 6, y2: y - 6 }));
  drawing.setAttribute("viewBox", `0 0 ${wide} ${y}`);
  const [title, said] = before
    ? ["Before: ", "each word at preferred sizes, end to end; the dashed lines are the canvas."]
    : marked
      ? [
          "After. ",
          `Letters are named i-j-k: word, column, letter, counted from 1. The marked one: ${system.ijk(marked)}.`,
        ]
      : ["Before (thin) and after. ", arrowsSaid(moment, all)];
  return h(
    "figure",
    { class: "fnb-forces-box" },
    h("figcaption", {}, h("strong", {}, title), h("span", { class: "fnb-muted" }, said)),
    drawing as never,
  );
}

function arrowsSaid(moment: Moment, all: readonly number[]): string {
  if (!moment.solved) return "Multipliers are known when the system is solved.";
  if (!all.some(isForce)) return "No forces: every symbol has the size that it likes.";
  return "Arrows are the multipliers: a blue letter is stretched and pulls its ends together, a red one is squeezed and pushes them apart. Orange: the canvas.";
}

function named({ symbol, mirrored }: LetterNote, x: number, y: number): SVGElement {
  const turn = mirrored ? `translate(${(2 * x).toFixed(1)} 0) scale(-1 1)` : null;
  return svg("text", { class: "fnb-forces-text", x: x.toFixed(1), y, transform: turn }, symbol);
}

/** What a letter does to its two ends: outwards where it pushes, inwards where it pulls. */
function arrows(from: number, to: number, y: number, force: number, largest: number): SVGElement[] {
  const long = Math.max(5, (ARROW * Math.abs(force)) / largest);
  const own = Math.min(long, Math.max(5, (to - from) / 2 - 2));
  const kind = force > 0 ? "pull" : "push";
  const ends: [number, number][] =
    force > 0
      ? [
          [from, 1],
          [to, -1],
        ]
      : [
          [from + own, -1],
          [to - own, 1],
        ];
  return ends.flatMap(([start, way]) => {
    const d = arrow(start, y, way * own);
    return [svg("path", { class: "fnb-force-under", d }), svg("path", { class: "fnb-force", "data-kind": kind, d })];
  });
}

function arrow(x: number, y: number, by: number): string {
  const way = Math.sign(by);
  const tip = x + by;
  return `M${x.toFixed(1)} ${y}H${tip.toFixed(1)}M${(tip - way * 4).toFixed(1)} ${y - 3.5}L${tip.toFixed(1)} ${y}L${(tip - way * 4).toFixed(1)} ${y + 3.5}`;
}

/** What holds the ends of the canvas where they are. */
function walls(
  system: System,
  moment: Moment,
  group: number,
  x: (value: number) => number,
  top: number,
  bottom: number,
  largest: number,
): SVGElement[] {
  const own = system.posed.meaning.flatMap((meaning, v) =>
    meaning.kind === "boundary" && meaning.group === group && system.posed.lower[v] === system.posed.upper[v]
      ? [v]
      : [],
  );
  return own.flatMap((v) => {
    const force = system.multiplier(v, moment);
    if (!isForce(force)) return [];
    const at = x(moment.values[v] ?? 0);
    // The multiplier is positive where the upper bound holds a boundary back.
    const by = (-Math.sign(force) * Math.max(8, (ARROW * Math.abs(force)) / largest)) as number;
    const y = (top + bottom) / 2;
    const d = arrow(at - by, y, by);
    const wall = svg("path", { class: "fnb-force fnb-force-wall", d });
    wall.append(svg("title", {}, `The canvas holds its end with ${formatNumber(Math.abs(force))}`));
    return [wall];
  });
}
