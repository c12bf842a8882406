// The matrix in the page: a row of elements for each layer, sizes and errors below.

import { h, mark } from "../../dom.ts";
import { formatNumber } from "../../fields.ts";
import { hueOf } from "../letters.ts";
import { linked, target } from "../links.ts";
import type { PathNote } from "../network/story.ts";
import type { Axis } from "../timeline.ts";
import type { Verdict } from "../weighing.ts";
import type { Drawn, Element, Piece } from "./matrix.ts";
import type { Trial } from "./trial.ts";

const WIDE = 760; // about how many pixels the matrix is wide

export interface MatrixOptions {
  path: PathNote;
  axis: Axis;
  drawn: Drawn;
  verdicts: readonly Verdict[];
  tried: boolean;
  solved: boolean;
  symbols: Record<string, number>;
  trial: Trial;
}

export function columnsTable(options: MatrixOptions): HTMLElement {
  const { path, drawn, trial } = options;
  const bandOf = new Map(path.bands.flatMap((band, b) => band.rows.map((row) => [row, b] as const)));
  const order = path.layers.map((layer, row) => ({ layer, band: bandOf.get(row) ?? 0 }));
  const shared = new Map<number, number>();
  for (const { band } of order) shared.set(band, (shared.get(band) ?? 0) + 1);
  const el = h("div", { class: "fnb-align", role: "table", "aria-label": `Alignment of group ${path.group}` });
  el.append(h("span", {}), head(options), h("span", { class: "fnb-align-sum fnb-muted" }, "Σ"));
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
    for (let boundary = 1; boundary < trial.count - 1; boundary++)
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
  const widths = options.solved
    ? drawn.boundaries.slice(1).map((end, j) => end - (drawn.boundaries[j] ?? 0))
    : options.verdicts.map(({ width }) => width);
  const sum = (list: readonly number[]) => list.reduce((all, own) => all + own, 0);
  const errors = options.verdicts.map(({ omega }) => omega);
  el.append(
    h("span", { class: "fnb-align-name" }, "size"),
    below(options, widths),
    h("span", { class: "fnb-align-sum" }, formatNumber(sum(widths), 2)),
    h("span", { class: "fnb-align-name" }, "error ω"),
    below(options, errors, true),
    h("span", { class: "fnb-align-sum fnb-align-omega" }, formatNumber(sum(errors), 2)),
  );
  return el;
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
function head(options: MatrixOptions): HTMLElement {
  const { drawn, trial, path, axis, tried } = options;
  const el = h("div", { class: "fnb-align-head" });
  for (let j = 0; j < drawn.elements.length; j++) {
    const [start, end] = [drawn.boundaries[j] ?? 0, drawn.boundaries[j + 1] ?? 0];
    const broken = options.verdicts[j]?.refusal;
    const cell = h(
      "span",
      { class: "fnb-align-number", "data-broken": !!broken, ...linked(keysOf(options, j)) },
      String(j + 1),
      trial.splitter(j),
    );
    el.append(at(cell, start, end, drawn));
  }
  for (let boundary = 1; boundary < trial.count - 1; boundary++) {
    const grip = trial.handle(boundary, null, "all");
    if (!tried)
      for (const [name, value] of Object.entries(linked([target.boundary(axis, path.group, boundary)])))
        mark(grip, name, value);
    el.append(grip);
  }
  return el;
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
function below(options: MatrixOptions, values: readonly number[], errors = false): HTMLElement {
  const { drawn } = options;
  const el = h("div", { class: errors ? "fnb-align-values fnb-align-errors" : "fnb-align-values", role: "row" });
  for (const [j, value] of values.entries()) {
    const [start, end] = [drawn.boundaries[j] ?? 0, drawn.boundaries[j + 1] ?? 0];
    const text = formatNumber(value, 2);
    const refused = options.verdicts[j]?.refusal;
    const cell = h(
      "span",
      {
        role: "cell",
        "data-error": errors && value > 1e-9,
        "data-broken": errors && !!refused,
        "data-narrow": (WIDE * (end - start)) / drawn.width < 7 * text.length,
        title: refused && errors ? refused.text() : null,
        ...linked(keysOf(options, j)),
      },
      text,
      errors && refused ? h("b", {}, ` ✕${/^C\d$/.test(refused.constraint) ? refused.constraint : ""}`) : null,
    );
    el.append(at(cell, start, end, drawn));
  }
  return el;
}
