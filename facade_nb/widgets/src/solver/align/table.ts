// The matrix in the page: a row of elements for each layer, sizes and errors below.

import { h, mark } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { hueOf } from "../letters.ts";
import { linked, target } from "../links.ts";
import type { PathNote } from "../network/story.ts";
import type { Axis } from "../timeline.ts";
import { rowsNamed, type Verdict } from "../weights.ts";
import type { Drawn, Element, Piece } from "./matrix.ts";
import type { Trial } from "./trial.ts";

const WIDE = 760; // about how many pixels the matrix is wide, as long as it is not known
const DIGIT = 6.8; // pixels of a digit
const ROOM = 4; // pixels between two labels
const LINES = 2; // for labels that do not fit into their columns

export interface MatrixOptions {
  path: PathNote;
  axis: Axis;
  drawn: Drawn;
  verdicts: readonly Verdict[];
  tried: boolean;
  solved: boolean;
  symbols: Record<string, number>;
  /** Its handles; without it the matrix is only looked at. */
  trial: Trial | null;
  /** The reader is asked: neither sizes nor errors are told; what begins at `open` is not cut yet. */
  asked?: { open: number } | null;
  /** What the question is about: a boundary of a band, or a column of all. */
  marked?: { boundary: number; band: number | null } | null;
}

/** A label of a column, which stands on another line where its column is too narrow for it. */
interface Label {
  el: HTMLElement;
  start: number;
  end: number;
  text: string;
}

export function columnsTable(options: MatrixOptions): HTMLElement {
  const { path, drawn, trial } = options;
  const bandOf = new Map(path.bands.flatMap((band, b) => band.rows.map((row) => [row, b] as const)));
  const order = path.layers.map((layer, row) => ({ layer, band: bandOf.get(row) ?? 0 }));
  const shared = new Map<number, number>();
  for (const { band } of order) shared.set(band, (shared.get(band) ?? 0) + 1);
  const el = h("div", { class: "fnb-align", role: "table", "aria-label": `Alignment of group ${path.group}` });
  const lines: { el: HTMLElement; labels: Label[] }[] = [head(options)];
  el.append(h("span", {}), lines[0]?.el as HTMLElement, h("span", { class: "fnb-align-sum fnb-muted" }, "Σ"));
  const seen = new Set<number>();
  for (const [row, { layer, band }] of order.entries()) {
    const first = !seen.has(band);
    seen.add(band);
    const place = row === 0 ? "first" : row === order.length - 1 ? "last" : "";
    const track = h("div", {
      class: "fnb-align-row",
      role: "row",
      "data-place": order.length === 1 ? "only" : place,
    });
    for (const [j, column] of drawn.elements.entries())
      track.append(...element(options, column[band] as Element, j, band, layer));
    for (let boundary = 1; trial && boundary < trial.count - 1; boundary++)
      if (first) track.append(trial.handle(boundary, band, layer));
    const total = drawn.elements.reduce(
      (sum, column) => sum + (column[band]?.pieces ?? []).reduce((own, piece) => own + piece.end - piece.start, 0),
      0,
    );
    el.append(
      h("span", { class: "fnb-align-layer", ...linked([target.layer(layer)]) }, layer),
      track,
      h("span", { class: "fnb-align-sum fnb-muted" }, formatNumber(total, 2)),
    );
  }
  const widths = drawn.boundaries.slice(1).map((end, j) => end - (drawn.boundaries[j] ?? 0));
  const sum = (list: readonly number[]) => list.reduce((all, own) => all + own, 0);
  const errors = options.verdicts.map(({ omega }) => omega);
  if (!options.asked) {
    const [sizes, omegas] = [below(options, widths), below(options, errors, true)];
    lines.push(sizes, omegas);
    const what = options.solved ? "Width of each column as it is solved" : "The largest size in each column";
    el.append(
      h("span", { class: "fnb-align-name", title: what }, "size, m"),
      sizes.el,
      h("span", { class: "fnb-align-sum" }, formatNumber(sum(widths), 2)),
      h("span", { class: "fnb-align-name", title: "max − min of a column, at preferred sizes (Eq. 9)" }, "error ω, m"),
      omegas.el,
      h("span", { class: "fnb-align-sum fnb-align-omega" }, formatNumber(sum(errors), 3)),
    );
  }
  const fit = () => {
    for (const line of lines) spread(line.el, line.labels, drawn);
  };
  fit();
  if (typeof ResizeObserver !== "undefined") new ResizeObserver(fit).observe(el);
  return el;
}

/** Put each label into its column, or, where that is too narrow, on a line of its own, or away. */
function spread(line: HTMLElement, labels: readonly Label[], drawn: Drawn): void {
  const scale = (line.clientWidth || WIDE) / drawn.width;
  const ends: number[] = [];
  for (const { el, start, end, text } of labels) {
    const wide = DIGIT * text.length;
    const left = (scale * (start + end)) / 2 - wide / 2;
    if (scale * (end - start) >= wide + 1) {
      mark(el, "data-line", null);
      continue;
    }
    let n = 0;
    while (n < LINES && left < (ends[n] ?? -ROOM) + ROOM) n++;
    if (n < LINES) ends[n] = left + wide;
    mark(el, "data-line", n < LINES ? String(n + 1) : "0");
  }
  mark(line, "data-lines", ends.length ? String(ends.length) : null);
}

const percent = (value: number, drawn: Drawn): string => `${((100 * value) / drawn.width).toFixed(3)}%`;

function at(el: HTMLElement, start: number, end: number, drawn: Drawn): HTMLElement {
  el.style.left = percent(start, drawn);
  el.style.width = percent(end - start, drawn);
  return el;
}

function keysOf({ path, axis, tried }: MatrixOptions, j: number): string[] {
  return tried ? [] : [target.column(axis, path.group, j)];
}

/** Above the matrix: numbers of the columns, and the handles that move a boundary in all rows. */
function head(options: MatrixOptions): { el: HTMLElement; labels: Label[] } {
  const { drawn, trial, path, axis, tried, asked, marked } = options;
  const el = h("div", { class: "fnb-align-head" });
  const labels: Label[] = [];
  for (let j = 0; j < drawn.elements.length; j++) {
    const [start, end] = [drawn.boundaries[j] ?? 0, drawn.boundaries[j + 1] ?? 0];
    const broken = options.verdicts[j]?.refusal;
    const text = asked && j >= asked.open ? "?" : String(j + 1);
    const cell = h(
      "span",
      {
        class: "fnb-align-number",
        "data-broken": !!broken,
        "data-marked": marked?.band === null && marked.boundary === j,
        ...linked(keysOf(options, j)),
      },
      h("span", {}, text),
      trial?.splitter(j) ?? null,
    );
    labels.push({ el: cell, start, end, text });
    el.append(at(cell, start, end, drawn));
  }
  for (let boundary = 1; trial && boundary < trial.count - 1; boundary++) {
    const grip = trial.handle(boundary, null, "all");
    if (!tried)
      for (const [name, value] of Object.entries(linked([target.boundary(axis, path.group, boundary)])))
        mark(grip, name, value);
    el.append(grip);
  }
  return { el, labels };
}

function element(options: MatrixOptions, own: Element, j: number, band: number, layer: string): HTMLElement[] {
  const { drawn, path, symbols, axis } = options;
  const [start, end] = [drawn.boundaries[j] ?? 0, drawn.boundaries[j + 1] ?? 0];
  const broken = options.verdicts[j]?.refusal;
  const blamed = !!broken && broken.bands.includes(band);
  const cell = h("span", {
    class: "fnb-align-cell",
    role: "cell",
    "data-broken": blamed,
    "data-empty": !own.pieces.length,
    "data-open": !!options.asked && j >= options.asked.open,
    "data-marked": options.marked?.boundary === j && (options.marked.band ?? band) === band,
    "data-whole": options.marked?.band === null,
    ...linked(keysOf(options, j)),
  });
  if (!own.pieces.length) cell.append("ε");
  const boxes = own.pieces.map((piece) => letterBox(piece));
  const gaps = own.gaps.map(([from, to]) =>
    at(h("span", { class: "fnb-align-gap", title: `γ: ${formatNumber(to - from, 3)} m` }, "γ"), from, to, drawn),
  );
  return [at(cell, start, end, drawn), ...gaps, ...boxes];

  function letterBox({ letter, start: from, end: to, part }: Piece): HTMLElement {
    const note = path.bands[band]?.letters[letter];
    if (!note) return h("span");
    const box = h("span", {
      class: `fnb-box ${hueOf(symbols, note.symbol)}`,
      "data-ghost": note.transparent,
      "data-open": !note.opaque && !note.transparent,
      "data-cut": part > 0,
      title: `${note.symbol}: ${formatNumber(to - from, 3)} m${part ? `, piece ${part}` : ""}`,
      ...linked([target.letter(axis, layer, letter)], [target.symbol(note.symbol), ...keysOf(options, j)]),
    });
    if ((WIDE * (to - from)) / drawn.width >= 8 * note.symbol.length) {
      box.append(note.mirrored ? h("i", { class: "fnb-mirrored" }, note.symbol) : note.symbol);
      if (part) box.append(h("sub", {}, String(part)));
    }
    return at(box, from, to, drawn);
  }
}

/** A line of numbers below the matrix, one for each column. */
function below(
  options: MatrixOptions,
  values: readonly number[],
  errors = false,
): { el: HTMLElement; labels: Label[] } {
  const { drawn } = options;
  const labels: Label[] = [];
  const el = h("div", { class: errors ? "fnb-align-values fnb-align-errors" : "fnb-align-values", role: "row" });
  for (const [j, value] of values.entries()) {
    const [start, end] = [drawn.boundaries[j] ?? 0, drawn.boundaries[j + 1] ?? 0];
    const refused = errors ? options.verdicts[j]?.refusal : undefined;
    const sign = refused ? ` ✕${/^C\d$/.test(refused.constraint) ? refused.constraint : ""}` : "";
    const text = formatNumber(value, errors ? 3 : 2);
    const cell = h(
      "span",
      {
        role: "cell",
        "data-error": errors && value > 1e-9,
        "data-broken": !!refused,
        title: refused ? rowsNamed(refused.text(), options.path.layers) : `Column ${j + 1}: ${text} m`,
        ...linked(keysOf(options, j)),
      },
      h("span", {}, text, refused ? h("b", {}, sign) : null),
    );
    labels.push({ el: cell, start, end, text: text + sign });
    el.append(at(cell, start, end, drawn));
  }
  return { el, labels };
}
