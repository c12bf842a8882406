// The path through a network of many words: every word is an axis to scale, and every node of the path a line across
// them all (parallel coordinates); beside them, how the words are joined pair by pair (supplement 3.3).

import { h, svg } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { hueOf } from "../letters.ts";
import { linked, target } from "../links.ts";
import { edgeKey } from "./scene.ts";
import { lettersBetween, type MergerNote, type Subject } from "./story.ts";

const WIDE = 860;
const LEFT = 108;
const TREE = 26;
const ROW = 46;
const BAR = 20;

interface Joint {
  bands: number[];
  y: number;
  level: number;
}

/**
 * @param choose shows a pair of words
 */
export function warp(
  subject: Subject,
  symbols: Record<string, number>,
  pair: readonly [number, number],
  merged: MergerNote | undefined,
  choose: (pair: [number, number]) => void,
): HTMLElement {
  const path = subject.path;
  if (!path) return h("div");
  const bands = subject.bands;
  const totals = bands.map((_, b) => path.columns.reduce((sum, own) => sum + sumOf(own.sizes[b]), 0));
  const longest = Math.max(1e-9, subject.canvas, ...totals);
  const scale = (WIDE - LEFT - 16) / longest;
  const height = bands.length * ROW + 14;
  const y = (b: number) => 10 + b * ROW;
  const levels = Math.ceil(Math.log2(Math.max(1, bands.length)));
  const total = WIDE + levels * TREE + 50;
  const drawing = svg("svg", { class: "fnb-warp", viewBox: `0 0 ${total} ${height}`, role: "img" });
  drawing.setAttribute("aria-label", `The path through ${bands.length} words: a line across them for every node`);
  const at = bands.map(() => [0]);
  for (const column of path.columns)
    for (const [b, own] of at.entries()) own.push((own.at(-1) ?? 0) + sumOf(column.sizes[b]));

  const x = (b: number, j: number) => LEFT + (at[b]?.[j] ?? 0) * scale;
  const columns = path.columns.map((column, j) => {
    const left: string[] = [];
    const right: string[] = [];
    for (const [b] of bands.entries()) {
      for (const edge of [y(b), y(b) + BAR]) left.push(`${x(b, j).toFixed(1)},${edge}`);
      for (const edge of [y(b), y(b) + BAR]) right.push(`${x(b, j + 1).toFixed(1)},${edge}`);
    }
    const before = j ? (path.columns[j - 1]?.after ?? []) : bands.map(() => 0);
    const is = [target.column(subject.axis, path.group, j), edgeKey(subject, before, column.letters)];
    const shape = svg("polygon", {
      class: "fnb-warp-column",
      points: [...left, ...right.reverse()].join(" "),
      ...linked(is),
    });
    shape.append(svg("title", {}, `column ${j + 1}: ω = ${formatNumber(column.omega)} m`));
    return shape;
  });
  drawing.append(...columns);

  for (const [b, band] of bands.entries()) {
    const rows = band.rows.map((row) => path.layers[row]).filter((name): name is string => !!name);
    const name = rows[0] ?? `word ${b + 1}`;
    const label = svg(
      "text",
      { class: "fnb-warp-name", x: LEFT - 8, y: y(b) + 14, ...linked(rows.map(target.layer)) },
      name.length > 12 ? `${name.slice(0, 11)}…` : name,
    );
    label.append(svg("title", {}, rows.join(", ")));
    if (pair.includes(b)) label.setAttribute("data-on", "");
    drawing.append(label);
    let place = 0;
    let from = LEFT;
    for (const column of path.columns) {
      const to = column.after[b] ?? place;
      const sizes = column.sizes[b] ?? [];
      for (const [k, n] of lettersBetween(place, to, sizes.length > 0).entries()) {
        const letter = band.letters[n];
        const wide = (sizes[k] ?? 0) * scale;
        if (!letter) continue;
        const keys = rows.map((layer) => target.letter(subject.axis, layer, n));
        const box = svg("rect", {
          class: `fnb-warp-letter ${hueOf(symbols, letter.symbol)}`,
          x: from.toFixed(1),
          y: y(b),
          width: Math.max(0.5, wide).toFixed(1),
          height: BAR,
          "data-ghost": letter.transparent,
          ...linked(keys, [target.symbol(letter.symbol)]),
        });
        drawing.append(box);
        if (wide >= 8 * letter.symbol.length)
          drawing.append(
            svg("text", { class: "fnb-warp-text", x: (from + wide / 2).toFixed(1), y: y(b) + 14 }, letter.symbol),
          );
        from += wide;
      }
      place = to;
    }
  }
  for (let j = 0; j <= path.columns.length; j++) {
    const points = bands.flatMap((_, b) => [
      `${x(b, j).toFixed(1)},${y(b) - 3}`,
      `${x(b, j).toFixed(1)},${y(b) + BAR + 3}`,
    ]);
    drawing.append(
      svg("polyline", {
        class: "fnb-warp-node",
        points: points.join(" "),
        ...linked([target.boundary(subject.axis, path.group, j)]),
      }),
    );
  }
  drawing.append(...tree(bands.length, y, choose, pair));
  const told = merged
    ? merged.event === "PairsMerged"
      ? `The search joined them so: J = ${formatNumber(merged.cost) || "–"} m.`
      : `The control words were aligned first: J = ${formatNumber(merged.cost) || "–"} m.`
    : "The brackets: words are joined pair by pair, then the pairs (supplement 3.3). A bracket shows its two words above.";
  return h(
    "figure",
    { class: "fnb-warp-box" },
    h("figcaption", {}, h("strong", {}, "The path across all words. "), told),
    drawing as never,
  );
}

/** Brackets: pairs in the order of the stack, then pairs of pairs. */
function tree(
  count: number,
  y: (b: number) => number,
  choose: (pair: [number, number]) => void,
  pair: readonly [number, number],
): SVGElement[] {
  let level: Joint[] = Array.from({ length: count }, (_, b) => ({ bands: [b], y: y(b) + BAR / 2, level: 0 }));
  const made: SVGElement[] = [];
  const right = (own: Joint) => WIDE - 6 + own.level * TREE;
  while (level.length > 1) {
    const next: Joint[] = [];
    for (let n = 0; n < level.length; n += 2) {
      const [one, other] = [level[n] as Joint, level[n + 1]];
      if (!other) {
        next.push(one);
        continue;
      }
      const depth = Math.max(one.level, other.level) + 1;
      const end = WIDE - 6 + depth * TREE;
      const own: [number, number] = [one.bands[0] ?? 0, other.bands[0] ?? 0];
      const bracket = svg("path", {
        class: "fnb-warp-bracket",
        d: `M${right(one)} ${one.y}H${end}V${other.y}H${right(other)}`,
        "data-on": own.join() === pair.join(),
      });
      const hit = svg("path", {
        class: "fnb-warp-hit",
        d: `M${right(one)} ${one.y}H${end}V${other.y}H${right(other)}`,
        tabindex: 0,
        role: "button",
        "aria-label": `Show words ${own[0] + 1} and ${own[1] + 1}`,
      });
      hit.append(
        svg(
          "title",
          {},
          `words ${one.bands.map((b) => b + 1).join(", ")} with ${other.bands.map((b) => b + 1).join(", ")}`,
        ),
      );
      hit.addEventListener("click", () => choose(own));
      hit.addEventListener("keydown", (event) => {
        if (event.key === "Enter" || event.key === " ") {
          event.preventDefault();
          choose(own);
        }
      });
      made.push(bracket, hit);
      next.push({ bands: [...one.bands, ...other.bands], y: (one.y + other.y) / 2, level: depth });
    }
    level = next;
  }
  return made;
}

const sumOf = (sizes: readonly number[] | undefined): number => (sizes ?? []).reduce((sum, size) => sum + size, 0);
