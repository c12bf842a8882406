// Which letter of which pattern a cell of the façade comes from, and the other way round: from what Python tells of the solved
// words (facade_nb/widgets/studio/words.py).

import type { SolvedLetters } from "../shared/stage.ts";
import type { Store } from "../shared/store.ts";
import { AXES, type Axis } from "../shared/types.ts";

/** A place in a pattern's text; with `index`, one letter of those that it makes in the word of an axis. */
export interface Place {
  pattern: string;
  offset: number;
  axis?: Axis | undefined;
  index?: number | undefined;
  /** Which letter it is of those that the place makes, and how many they are. */
  copy?: readonly [number, number] | undefined;
}

/** Whether two places may be the same: what one of them does not tell, the other may. */
export function samePlace(a: Place, b: Place): boolean {
  if (a.pattern !== b.pattern || a.offset !== b.offset) return false;
  if (a.axis !== undefined && b.axis !== undefined && a.axis !== b.axis) return false;
  return a.index === undefined || b.index === undefined || a.index === b.index;
}

/** What a cell of the façade says of itself. */
export interface Celled {
  layer?: string | undefined;
  x?: string | undefined;
  y?: string | undefined;
  /** Which instances of the two symbols it is, such as "2 1". */
  number?: string | undefined;
}

interface Row {
  letters: SolvedLetters["letters"];
  /** By symbol, the letters that are drawn, in order. */
  solid: Map<string, number[]>;
  /** By index, which of the letters of its place it is. */
  copies: (readonly [number, number])[];
}

const rows = new WeakMap<SolvedLetters, Row>();

function rowOf(solved: SolvedLetters): Row {
  const known = rows.get(solved);
  if (known) return known;
  const solid = new Map<string, number[]>();
  const counts = new Map<number, number>();
  const ordinals = solved.letters.map(([symbol, offset, , , flags], index) => {
    if (!flags.includes("t")) solid.set(symbol, [...(solid.get(symbol) ?? []), index]);
    const ordinal = (counts.get(offset) ?? 0) + 1;
    counts.set(offset, ordinal);
    return ordinal;
  });
  const copies = solved.letters.map(([, offset], index) => [ordinals[index] ?? 1, counts.get(offset) ?? 1] as const);
  const row = { letters: solved.letters, solid, copies };
  rows.set(solved, row);
  return row;
}

/** The places that a cell's two letters come from; those that are not known are missing. */
export function placesOf(store: Store, cell: Celled): Place[] {
  const layer = store.get("design").layers.find(({ name }) => name === cell.layer);
  if (!layer || !cell.number) return [];
  const numbers = cell.number.split(" ").map(Number);
  return AXES.flatMap((axis, n): Place[] => {
    const { pattern } = layer[axis];
    const symbol = cell[axis];
    const solved = store.get("letters")[axis]?.[pattern];
    if (!solved || !symbol) return [];
    const row = rowOf(solved);
    const index = row.solid.get(symbol)?.[(numbers[n] ?? 0) - 1];
    const letter = index === undefined ? undefined : row.letters[index];
    if (index === undefined || !letter) return [];
    return [{ pattern, offset: letter[1], axis, index, copy: row.copies[index] }];
  });
}

/** Where the letters of a place stand on the façade: each axis with its interval, metres. */
export function bandsOf(store: Store, places: readonly Place[]): { axis: Axis; start: number; end: number }[] {
  return AXES.flatMap((axis) =>
    places.flatMap((place) => {
      const solved = store.get("letters")[axis]?.[place.pattern];
      return (solved?.letters ?? []).flatMap(([, offset, start, end], index) =>
        samePlace(place, { pattern: place.pattern, offset, axis, index }) ? [{ axis, start, end }] : [],
      );
    }),
  );
}

/** Whether the solved words of a pattern are those of this text. */
export function isText(store: Store, pattern: string, text: string): boolean {
  return AXES.some((axis) => store.get("letters")[axis]?.[pattern]?.text === text);
}
