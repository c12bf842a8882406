// An alignment as the paper's matrix (Eq. 8): where each word is cut, what stands in each element, and where it is drawn.

import { lettersBetween, type PathNote } from "../network/story.ts";
import type { PlacedLetter } from "../placing.ts";
import type { Column } from "../weights.ts";

/** Where the words are cut: per boundary, the place of each band; and which elements have letters in them. */
export interface Cuts {
  places: number[][];
  /** Per column, per band. */
  filled: boolean[][];
}

export interface Piece {
  letter: number;
  start: number;
  end: number;
  /** Number of the piece of a letter that is cut, from 1; 0: it is whole. */
  part: number;
}

/** An element of the matrix, drawn: its letters and pieces, and the gaps beside them that γ fill. */
export interface Element {
  pieces: Piece[];
  gaps: [number, number][];
}

export interface Drawn {
  /** Metres: every boundary, 0 first. */
  boundaries: number[];
  /** Per column, per band. */
  elements: Element[][];
  width: number;
}

export function cutsOf(path: PathNote): Cuts {
  return {
    places: [path.bands.map(() => 0), ...path.columns.map((column) => [...column.after])],
    filled: path.columns.map((column) => column.letters.map((letters) => letters.length > 0)),
  };
}

export function columnsOf({ places, filled }: Cuts): Column[] {
  return filled.map((own, j) => own.map((is, b) => lettersBetween(places[j]?.[b] ?? 0, places[j + 1]?.[b] ?? 0, is)));
}

/** The places where a band may be cut at a boundary, its neighbours staying where they are. */
export function choices(path: PathNote, { places }: Cuts, boundary: number, band: number): number[] {
  const [from, to] = [places[boundary - 1]?.[band] ?? 0, places[boundary + 1]?.[band] ?? 0];
  const word = path.bands[band]?.letters ?? [];
  const found: number[] = [];
  for (let place = from; place <= to; place++) if (!(place & 1) || word[place >> 1]?.transparent) found.push(place);
  return found;
}

/** Move a boundary of one band. */
export function moved({ places, filled }: Cuts, boundary: number, band: number, place: number): Cuts {
  const next = places.map((own, j) => (j === boundary ? own.map((old, b) => (b === band ? place : old)) : own));
  const full = filled.map((own, j) =>
    own.map((was, b) => {
      if (b !== band || (j !== boundary && j !== boundary - 1)) return was;
      const [from, to] = [next[j]?.[b] ?? 0, next[j + 1]?.[b] ?? 0];
      return to > from || (to === from && (to & 1) === 1 && was);
    }),
  );
  return { places: next, filled: full };
}

/** Take a boundary away: its two columns become one. */
export function merged({ places, filled }: Cuts, boundary: number): Cuts {
  const [left, right] = [filled[boundary - 1] ?? [], filled[boundary] ?? []];
  return {
    places: places.filter((_, j) => j !== boundary),
    filled: [
      ...filled.slice(0, boundary - 1),
      left.map((own, b) => own || (right[b] ?? false)),
      ...filled.slice(boundary + 1),
    ],
  };
}

/** Cut a column in two, each word near its middle. */
export function split(path: PathNote, { places, filled }: Cuts, column: number): Cuts {
  const [from, to] = [places[column] ?? [], places[column + 1] ?? []];
  const between = from.map((start, b) => {
    const end = to[b] ?? start;
    if (end - start <= 2 && path.bands[b]?.letters[start >> 1]?.transparent) return start | 1;
    return Math.max(start, Math.min(end, 2 * Math.round((start + end) / 4)));
  });
  const was = filled[column] ?? [];
  const first = between.map((middle, b) => (was[b] ?? false) && (middle > (from[b] ?? 0) || (middle & 1) === 1));
  const second = between.map((middle, b) => (was[b] ?? false) && ((to[b] ?? 0) > middle || (middle & 1) === 1));
  return {
    places: [...places.slice(0, column + 1), between, ...places.slice(column + 1)],
    filled: [...filled.slice(0, column), first, second, ...filled.slice(column + 1)],
  };
}

/** The matrix at preferred sizes: every column as wide as its largest element. */
export function atPreferred(path: PathNote, cuts: Cuts, placements: Readonly<Record<string, string>>): Drawn {
  const columns = columnsOf(cuts);
  const sizes = sizesOf(path, columns);
  const least = path.canvas * 0.025;
  const boundaries = [0];
  const elements: Element[][] = [];
  for (const [j, column] of columns.entries()) {
    const sum = (b: number, which: (letter: number) => boolean) =>
      (column[b] ?? []).reduce((all, n, k) => all + (which(n) ? (sizes[j]?.[b]?.[k] ?? 0) : 0), 0);
    const totals = column.map((_, b) => sum(b, () => true));
    const soft = column.map((own, b) => own.map((n) => isElastic(path, columns, j, b, n)));
    const rigid = column.map((own, b) => sum(b, (n) => !soft[b]?.[own.indexOf(n)]));
    // An element of no width, which only the reader can make, is drawn so that it can be taken hold of.
    const width = Math.max(0, ...(rigid.some((own) => own > 0) ? rigid : totals)) || least;
    const start = boundaries.at(-1) ?? 0;
    boundaries.push(start + width);
    elements.push(
      column.map((letters, b) => {
        // Only what is elastic gives way to what is not.
        const [own, hard] = [totals[b] ?? 0, rigid[b] ?? 0];
        const stretch = own > hard ? (width - hard) / (own - hard) : 1;
        const total = own > hard ? width : own;
        const open = letters
          .map((n) => path.bands[b]?.letters[n])
          .find((own) => own && !own.opaque && !own.transparent);
        const room = Math.max(0, width - total);
        const placement = open ? turned(placements[open.symbol] ?? "center", open.mirrored) : "left";
        let at = start + (open ? ({ left: 0, right: room }[placement] ?? room / 2) : 0);
        const first = at;
        const pieces = letters.map((letter, k): Piece => {
          const from = at;
          at += (sizes[j]?.[b]?.[k] ?? 0) * (soft[b]?.[k] ? stretch : 1);
          return { letter, start: from, end: at, part: partOf(columns, j, b, letter) };
        });
        return { pieces, gaps: open ? gapsOf(start, start + width, first, at) : [] };
      }),
    );
  }
  return { boundaries, elements, width: boundaries.at(-1) ?? 0 };
}

const turned = (placement: string, mirrored: boolean): string =>
  mirrored ? ({ left: "right", right: "left" }[placement] ?? placement) : placement;

function gapsOf(start: number, end: number, first: number, last: number): [number, number][] {
  const found: [number, number][] = [];
  if (first - start > 1e-6) found.push([start, first]);
  if (end - last > 1e-6) found.push([last, end]);
  return found;
}

/** How large an element is drawn, metres. */
export const sizeIn =
  ({ elements }: Drawn) =>
  (column: number, band: number): number =>
    (elements[column]?.[band]?.pieces ?? []).reduce((sum, { start, end }) => sum + end - start, 0);

/** The matrix as it was solved: every letter where it stands. */
export function asSolved(path: PathNote, boundaries: number[], placed: readonly PlacedLetter[]): Drawn {
  const columns = columnsOf(cutsOf(path));
  const elements = columns.map((column, j) =>
    column.map((letters, b): Element => {
      const layer = path.layers[path.bands[b]?.rows[0] ?? 0];
      const own = placed.filter((each) => each.layer === layer && each.column === j).sort((x, y) => x.place - y.place);
      const pieces = own.map((each, k): Piece => {
        const letter = letters[k] ?? each.letter;
        return { letter, start: each.start, end: each.end, part: partOf(columns, j, b, letter) };
      });
      const [first, last] = [pieces[0], pieces.at(-1)];
      const gaps = first && last ? gapsOf(boundaries[j] ?? 0, boundaries[j + 1] ?? 0, first.start, last.end) : [];
      return { pieces, gaps };
    }),
  );
  return { boundaries, elements, width: boundaries.at(-1) ?? 0 };
}

/** Sizes of letters and pieces: those of the solver's alignment where nothing was moved, else as near as they can be. */
export function sizesOf(path: PathNote, columns: readonly Column[]): number[][][] {
  const total = path.bands.map((band, b) =>
    band.letters.map((letter, n) => {
      if (letter.size !== null) return letter.size;
      return path.columns.reduce((sum, own) => sum + (own.sizes[b]?.[own.letters[b]?.indexOf(n) ?? -1] ?? 0), 0);
    }),
  );
  if (JSON.stringify(columns) === JSON.stringify(path.columns.map((own) => own.letters)))
    return path.columns.map((own) => own.sizes);
  const size = (b: number, n: number) => total[b]?.[n] ?? 0;
  const whole = (b: number, n: number) => columns.filter((own) => own[b]?.includes(n)).length === 1;
  const rigid = columns.map((column) =>
    Math.max(0, ...column.map((own, b) => own.reduce((sum, n) => sum + (whole(b, n) ? size(b, n) : 0), 0))),
  );
  return columns.map((column, j) =>
    column.map((own, b) =>
      own.map((n) => {
        if (whole(b, n)) return size(b, n);
        const spans = columns.flatMap((other, k) => (other[b]?.includes(n) ? [k] : []));
        const room = spans.reduce((sum, k) => sum + (rigid[k] ?? 0), 0);
        return room > 0 ? (size(b, n) * (rigid[j] ?? 0)) / room : size(b, n) / spans.length;
      }),
    ),
  );
}

/** Whether a letter in a column has no size of its own there: it is unsized, or a piece. */
function isElastic(path: PathNote, columns: readonly Column[], j: number, b: number, letter: number): boolean {
  return path.bands[b]?.letters[letter]?.size === null || partOf(columns, j, b, letter) > 0;
}

/** Which piece of a letter stands in a column, from 1; 0: the letter is whole. */
function partOf(columns: readonly Column[], j: number, b: number, letter: number): number {
  const spans = columns.flatMap((own, k) => (own[b]?.includes(letter) ? [k] : []));
  return spans.length > 1 ? spans.indexOf(j) + 1 : 0;
}

/** Where a place of a band lies in a drawing: between two letters, or in the middle of one that is cut. */
export function positionOf(path: PathNote, drawn: Drawn, band: number, place: number): number {
  const pieces = drawn.elements.flatMap((column) => column[band]?.pieces ?? []);
  const of = (letter: number) => pieces.filter((piece) => piece.letter === letter);
  const n = place >> 1;
  const [before, here] = [of(n - 1).at(-1), of(n)];
  const [first, last] = [here[0], here.at(-1)];
  if (place & 1 && first && last) return (first.start + last.end) / 2;
  if (place >= 2 * (path.bands[band]?.letters.length ?? 0)) return drawn.width;
  if (!before) return first?.start ?? 0;
  return first ? (before.end + first.start) / 2 : before.end;
}
