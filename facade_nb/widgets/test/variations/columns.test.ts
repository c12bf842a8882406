import { expect, it } from "vitest";
import { columnsOf, ordered } from "../../src/variations/columns.ts";
import type { VariantRow } from "../../src/variations/types.ts";

const row = (width: number, windows?: number): VariantRow => ({
  values: [width, null],
  opens: true,
  ...(windows === undefined ? { state: "error" } : { state: "done", windows }),
});
const rows = [row(6, 5), row(9, 13), row(0.3), row(7.5, 9), row(8, 9)];
const columns = columnsOf(["width", "B"]);

it("sorts by a column, either way; rows without a value stay last, equal ones in order", () => {
  expect(ordered(rows, columns, "")).toEqual([0, 1, 2, 3, 4]);
  expect(ordered(rows, columns, "width")).toEqual([2, 0, 3, 4, 1]);
  expect(ordered(rows, columns, "windows")).toEqual([0, 3, 4, 1, 2]);
  expect(ordered(rows, columns, "-windows")).toEqual([1, 3, 4, 0, 2]);
  expect(ordered(rows, columns, "-nothing")).toEqual([0, 1, 2, 3, 4]);
});

it("writes numbers as people do, and nothing where there is none", () => {
  const text = (at: number, key: string) => columns.find((column) => column.key === key)?.text(rows[at] as VariantRow);
  expect([text(0, "width"), text(0, "B"), text(2, "windows"), text(1, "windows")]).toEqual(["6", "", "", "13"]);
});
