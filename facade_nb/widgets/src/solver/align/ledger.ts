// The ledger of J: every term of the objective in every column, and their sums.

import { h } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import type { Ledger, Objective, Weight } from "../weights.ts";

const WIDE = 24; // so many columns are shown one by one

/** A line for each term; `least`: elastic letters are charged nothing, so that the sums are lower bounds. */
export function ledgerTable(ledger: Ledger, objective: Objective, least: boolean): HTMLElement {
  const single = ledger.columns.length <= WIDE ? ledger.columns : [];
  const number = (value: number) => h("td", { "data-zero": Math.abs(value) < 5e-7 }, formatNumber(value, 3));
  const line = (label: string, title: string, of: ((column: Weight) => number) | null, sum: number) =>
    h(
      "tr",
      {},
      h("th", { scope: "row", title }, label),
      ...single.map((column) => (of ? number(of(column)) : h("td", {}))),
      number(sum),
    );
  const price = (value: number) => (value === 1 ? "" : `${formatNumber(value)}·`);
  return h(
    "div",
    { class: "fnb-ledger-box" },
    h(
      "table",
      { class: "fnb-ledger", "aria-label": "J term by term, metres" },
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          h("th", { scope: "col" }, "J, metres"),
          ...single.map((_, j) => h("th", { scope: "col" }, String(j + 1))),
          h("th", { scope: "col" }, "Σ"),
        ),
      ),
      h(
        "tbody",
        {},
        line("ω", "The error of a column (Eq. 9): largest − smallest", ({ omega }) => omega, ledger.omega),
        line(
          `empty: ${price(objective.empty)}E`,
          "Width of the column × share of the rows that are empty in it",
          ({ empty }) => empty,
          ledger.empty,
        ),
        line(
          `loose: ${price(objective.loose)}Λ`,
          "Letters that share an element, and letters that do not fill their column",
          ({ loose }) => loose,
          ledger.loose,
        ),
        line(
          `fit: ${price(objective.fit)}|W − canvas|`,
          "What all columns together miss the canvas by",
          null,
          ledger.fit,
        ),
      ),
      h(
        "tfoot",
        {},
        line(least ? "J ≥" : "J =", "All terms together", ({ cost }) => cost, ledger.cost),
      ),
    ),
  );
}
