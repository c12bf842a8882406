// What is typed to filter a table: `best`, `k=7`, `J<1 columns>=5`. All parts must hold; a part that names no number is
// looked for in the row's texts.

export interface Filterable {
  numbers: Record<string, number | null>;
  texts: string[];
}

const COMPARED = /^(.+?)(<=|>=|=|<|>|≤|≥)(-?\d+(?:[.,]\d+)?)$/;

const HOLDS: Record<string, (a: number, b: number) => boolean> = {
  "=": (a, b) => Math.abs(a - b) < 5e-4,
  "<": (a, b) => a < b,
  ">": (a, b) => a > b,
  "<=": (a, b) => a <= b,
  ">=": (a, b) => a >= b,
  "≤": (a, b) => a <= b,
  "≥": (a, b) => a >= b,
};

/** What decides whether a row is shown. */
export function filter(typed: string): (row: Filterable) => boolean {
  const parts = typed.trim().split(/\s+/).filter(Boolean);
  const tests = parts.map((part): ((row: Filterable) => boolean) => {
    const [, name = "", operator = "", value = ""] = COMPARED.exec(part) ?? [];
    const holds = HOLDS[operator];
    const text = part.toLowerCase();
    return (row) => {
      if (holds && name in row.numbers) {
        const own = row.numbers[name] ?? null;
        return own !== null && holds(own, Number(value.replace(",", ".")));
      }
      return row.texts.some((each) => each.toLowerCase().includes(text));
    };
  });
  return (row) => tests.every((test) => test(row));
}
