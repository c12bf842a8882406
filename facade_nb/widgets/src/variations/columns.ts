// The columns of the table: the values that differ, then what the solver found; and the order of rows by one of them.

import { formatNumber } from "../shared/fields.ts";
import type { VariantRow } from "./types.ts";

export interface Column {
  key: string;
  title: string;
  /** What it is, in words. */
  hint: string;
  /** What rows are sorted by; null comes last, whichever way. */
  of(row: VariantRow): number | null;
  text(row: VariantRow): string;
  /** How much it matters where there is little room: 0 is always shown. */
  rank: 0 | 1 | 2;
}

const FIGURES = 3;

export function columnsOf(names: readonly string[]): Column[] {
  const value = (name: string, at: number): Column => ({
    key: name,
    title: name,
    hint: name === "width" || name === "height" ? `${name} of the canvas, metres` : name,
    of: (row) => row.values[at] ?? null,
    text: (row) => formatNumber(row.values[at]),
    rank: 0,
  });
  const found = (
    key: string,
    title: string,
    hint: string,
    rank: Column["rank"],
    of: (row: VariantRow) => number | undefined,
    digits = FIGURES,
  ): Column => ({ key, title, hint, rank, of: (row) => of(row) ?? null, text: (row) => formatNumber(of(row), digits) });
  return [
    ...names.map(value),
    found("windows", "windows", "How many windows it has", 0, (row) => row.windows),
    found("shapes", "shapes", "How many shapes it has", 2, (row) => row.shapes),
    found(
      "x_cost",
      "cost x",
      "J across: how far sizes and places are from what was asked for",
      1,
      ({ cost }) => cost?.[0],
    ),
    found(
      "y_cost",
      "cost y",
      "J along: how far sizes and places are from what was asked for",
      1,
      ({ cost }) => cost?.[1],
    ),
    found("seconds", "seconds", "How long it took to solve", 2, (row) => row.seconds, 2),
  ];
}

/** The numbers of the rows, in the order that is asked for: a column's key, with "-" before it the largest first. */
export function ordered(rows: readonly VariantRow[], columns: readonly Column[], sort: string): number[] {
  const order = rows.map((_, at) => at);
  const column = columns.find(({ key }) => key === sort.replace(/^-/, "") && sort !== "");
  if (!column) return order;
  const sign = sort.startsWith("-") ? -1 : 1;
  return order.sort((a, b) => {
    const [x, y] = [column.of(rows[a] as VariantRow), column.of(rows[b] as VariantRow)];
    if (x === null || y === null) return Number(x === null) - Number(y === null) || a - b;
    return sign * (x - y) || a - b;
  });
}
