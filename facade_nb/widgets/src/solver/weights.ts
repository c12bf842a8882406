// What a column weighs and which constraint it breaks: the browser's twin of facade_nb/solver/trace/weights.py, so that
// an alignment tried by hand is judged while it is dragged, and a saved page judges without a kernel. Tests hold every
// edge of the lattices of real designs, and alignments made up at random, to what Python says.

import { isShort, type LetterNote } from "./letters.ts";

export const EPS = 1e-9;

export interface BandNote {
  letters: LetterNote[];
  /** Rows that have this word; 0 is the top. */
  rows: number[];
}

export interface Objective {
  empty: number;
  loose: number;
  fit: number;
  plain: boolean;
}

/** An element that a band may put into the next column (`alignment/elements.py`). */
export interface Option {
  /** 8·next letter + 4 inside a cut letter + 2 may not begin next + 1 may not be empty next (C4). */
  target: number;
  empty: boolean;
  transparent: boolean;
  /** Metres; null: elastic. */
  size: number | null;
  /** Metres: its whole sized letters; of an elastic element, less than its size. */
  least: number;
  loose: number;
  soft: boolean;
  opaque: boolean;
  guarded: boolean;
  begins: boolean;
  ends: boolean;
  letters: number[];
}

export interface Weight {
  omega: number;
  cost: number;
  width: number;
  /** What it adds to J beside ω: empty·E and loose·Λ of the column, metres. */
  empty: number;
  loose: number;
}

export interface Refusal {
  constraint: string;
  bands: number[];
  /** Letters to blame, as (band, letter). */
  letters: [number, number][];
  text: () => string;
}

type Choice = [Option, Refusal | null];

const letterName = ({ symbol, mirrored }: LetterNote): string =>
  (isShort(symbol) ? symbol : `<${symbol}>`) + (mirrored ? "'" : "");

/** Three significant digits, as Python's `:.3g` for numbers of ordinary size. */
export const brief = (value: number): string => String(Number(value.toPrecision(3)));

/** A group whose words are aligned. */
export class Group {
  readonly share: number;
  /** No letter is opaque: C1 does not apply. */
  readonly waived: boolean;
  /** Per band: the bands with a row above one of its rows (C3). */
  readonly guards: number[][];
  private readonly choices: Map<number, Choice[]>[];

  constructor(
    readonly bands: readonly BandNote[],
    readonly canvas: number,
    readonly tolerance: number,
    readonly objective: Objective,
    /** Whether transparent letters may be cut. */
    readonly cuts = true,
  ) {
    this.share = 1 / Math.max(1, bands.length);
    this.waived = !bands.some((band) => band.letters.some((letter) => letter.opaque));
    this.guards = bands.map((band) =>
      bands.flatMap((other, o) => (Math.min(...other.rows) < Math.max(...band.rows) ? [o] : [])),
    );
    this.choices = bands.map(() => new Map());
  }

  /** The positions of all bands at the start. */
  get start(): number[] {
    return this.bands.map(() => 0);
  }

  /** Every element that a band may put into the next column, and those that C2 or C4 keep from it. */
  elements(b: number, position: number): Choice[] {
    const known = this.choices[b]?.get(position);
    if (known) return known;
    const made = [...this.make(b, position)];
    this.choices[b]?.set(position, made);
    return made;
  }

  row(b: number): string {
    return `row ${Math.min(...(this.bands[b]?.rows ?? [0]))}`;
  }

  private *make(b: number, position: number): Generator<Choice> {
    const word = this.bands[b]?.letters ?? [];
    const [i, mid, gap, held] = [position >> 3, position & 4, position & 2, position & 1];
    const at = (n: number) => word[n] as LetterNote;
    if (held) {
      const text = () =>
        `${letterName(at(i - 1))} is attached and ends its element, so ${this.row(b)} may not be empty next (C4).`;
      const refusal: Refusal = { constraint: "C4", bands: [b], letters: [[b, i - 1]], text };
      yield [this.nothing(word, i, mid), refusal];
    } else {
      yield [this.nothing(word, i, mid), null];
    }
    if (i === word.length) return;
    if (at(i).transparent) {
      for (const option of this.clear(word, i, mid !== 0)) yield [option, null];
    } else {
      const text = () =>
        `${letterName(at(i))} is attached and begins its element, but ${this.row(b)} was empty before it (C4).`;
      const refusal: Refusal = { constraint: "C4", bands: [b], letters: [[b, i]], text };
      for (const option of this.solid(word, i)) yield [option, gap ? refusal : null];
    }
    let [clear, solid] = [false, false];
    let size: number | null = mid ? null : 0;
    for (let j = i; j < word.length; j++) {
      const letter = at(j);
      if (letter.transparent) clear = true;
      else solid = true;
      size = size === null || letter.size === null ? null : size + letter.size;
      if (!clear || !solid) continue;
      const letters = run(i, j);
      const text = () =>
        `${letters.map((n) => letterName(at(n))).join(" ")} of ${this.row(b)} are partly transparent, partly not (C2).`;
      const refusal: Refusal = { constraint: "C2", bands: [b], letters: letters.map((n) => [b, n]), text };
      const own = { ...BARE, begins: !mid, letters };
      if (letter.transparent && this.cuts) yield [{ ...own, target: 8 * j + 4, size: null }, refusal];
      const next = letter.attached && !letter.transparent ? 1 : 0;
      yield [{ ...own, target: 8 * (j + 1) + next, size, ends: true }, refusal];
    }
  }

  private nothing(word: readonly LetterNote[], i: number, mid: number): Option {
    const next = word[i];
    const ahead = next !== undefined && !mid && next.attached && !next.transparent;
    return { ...BARE, target: 8 * i + mid + (ahead ? 2 : 0), empty: true };
  }

  private *solid(word: readonly LetterNote[], i: number): Generator<Option> {
    let [size, loose, soft, guarded] = [0, 0, false, false];
    for (let j = i; j < word.length; j++) {
      const letter = word[j] as LetterNote;
      if (letter.transparent) return;
      const own = letter.size ?? 0;
      if (j > i) loose += Math.min(own, word[j - 1]?.size ?? 0);
      size += own;
      soft ||= !letter.opaque;
      guarded ||= letter.unoccludable;
      const target = 8 * (j + 1) + (letter.attached ? 1 : 0);
      const ends = { target, size, least: size, loose, soft, opaque: !soft, guarded, letters: run(i, j) };
      yield { ...BARE, ...ends, begins: true, ends: true };
    }
  }

  private *clear(word: readonly LetterNote[], i: number, mid: boolean): Generator<Option> {
    let fixed: number | null = mid ? null : 0;
    let least = 0;
    for (let j = i; j < word.length; j++) {
      const letter = word[j] as LetterNote;
      if (!letter.transparent) return;
      const own = { ...BARE, transparent: true, begins: !mid, letters: run(i, j) };
      if (this.cuts) yield { ...own, target: 8 * j + 4, size: null, least };
      const whole = j > i || !mid ? letter.size : null;
      least += whole ?? 0;
      fixed = fixed === null || whole === null ? null : fixed + whole;
      yield { ...own, target: 8 * (j + 1), size: fixed, least, ends: true };
    }
  }
}

const BARE = {
  empty: false,
  transparent: false,
  size: 0,
  least: 0,
  loose: 0,
  soft: false,
  opaque: false,
  guarded: false,
  begins: false,
  ends: false,
  letters: [] as number[],
} as const satisfies Omit<Option, "target"> & { size: number };

const run = (i: number, j: number): number[] => Array.from({ length: j - i + 1 }, (_, n) => i + n);

/** ω (Eq. 9, or its variant for non-opaque rows), ω + empty·E + loose·Λ, and the width of a column. */
export function weigh({ objective, share }: Group, column: readonly Option[]): Weight {
  let [high, low, lowest] = [0, Infinity, Infinity];
  let [empties, softs, loose, softSizes, elastic] = [0, 0, 0, 0, false];
  for (const option of column) {
    if (option.empty) empties++;
    else if (option.size === null) {
      elastic = true;
      high = Math.max(high, option.least);
    } else {
      high = Math.max(high, option.size);
      lowest = Math.min(lowest, option.size);
      if (objective.plain || !option.soft) low = Math.min(low, option.size);
      loose += option.loose;
      if (option.soft) {
        softs++;
        softSizes += option.size;
      }
    }
  }
  if (low === Infinity) low = elastic || lowest === Infinity ? high : lowest;
  const omega = Math.max(0, high - low);
  const [E, L] = [share * empties * high, share * (loose + softs * high - softSizes)];
  const parts = { empty: objective.empty * E, loose: objective.loose * L };
  return { omega, cost: omega + parts.empty + parts.loose, width: high, ...parts };
}

/** J of an alignment, term by term: its columns, and what W misses the canvas by. */
export interface Ledger {
  columns: Weight[];
  fit: number;
  omega: number;
  empty: number;
  loose: number;
  cost: number;
}

/** The ledger of J; the one place where its terms are added up. `width`: W, where the columns do not say it exactly. */
export function ledgerOf(group: Group, columns: readonly Weight[], width?: number): Ledger {
  const sum = (name: "omega" | "empty" | "loose" | "width" | "cost") =>
    columns.reduce((all, column) => all + column[name], 0);
  const fit = group.objective.fit * Math.abs((width ?? sum("width")) - group.canvas);
  return {
    columns: [...columns],
    fit,
    omega: sum("omega"),
    empty: sum("empty"),
    loose: sum("loose"),
    cost: sum("cost") + fit,
  };
}

/** The first constraint that a column breaks, of those that do not depend on what came before. */
export function refusal(group: Group, owed: boolean, column: readonly Option[]): Refusal | null {
  return (
    nobody(column) ?? tooFar(group, column) ?? covered(group, column) ?? bare(group, column) ?? adrift(owed, column)
  );
}

/** All of them. */
function refusals(group: Group, owed: boolean, column: readonly Option[]): Refusal[] {
  const empty = nobody(column);
  const found = empty
    ? [empty]
    : [tooFar(group, column), covered(group, column), bare(group, column), adrift(owed, column)];
  return found.filter((own) => own !== null);
}

const everyone = (column: readonly Option[]): number[] => column.map((_, b) => b);

function nobody(column: readonly Option[]): Refusal | null {
  if (!column.every((option) => option.empty)) return null;
  return { constraint: "empty", bands: everyone(column), letters: [], text: () => "No row has a letter in it." };
}

/** C1. */
function bare(group: Group, column: readonly Option[]): Refusal | null {
  const needy = everyone(column).filter((b) => column[b]?.empty || column[b]?.soft);
  if (!needy.length || group.waived || column.some((option) => option.opaque)) return null;
  const soft = needy.flatMap((b) =>
    (column[b]?.letters ?? []).flatMap((i): [number, number][] => (letterAt(group, b, i).opaque ? [] : [[b, i]])),
  );
  const text = () => {
    const names = soft.map(([b, i]) => letterName(letterAt(group, b, i))).join(", ");
    const what = soft.length ? `${names} is not opaque` : `${group.row(needy[0] ?? 0)} is empty`;
    return `${what}, and no row stands behind it with opaque letters (C1).`;
  };
  return { constraint: "C1", bands: needy, letters: soft, text };
}

function adrift(owed: boolean, column: readonly Option[]): Refusal | null {
  if (!owed || column.some((option) => option.begins)) return null;
  const text = () => "The boundary before it is no row's letter boundary.";
  return { constraint: "boundary", bands: everyone(column), letters: [], text };
}

const letterAt = (group: Group, b: number, i: number): LetterNote => group.bands[b]?.letters[i] as LetterNote;

function tooFar(group: Group, column: readonly Option[]): Refusal | null {
  const { omega } = weigh(group, column);
  if (omega - group.tolerance <= EPS) return null;
  const reach = column.flatMap((option, b) => (option.empty ? [] : [{ size: option.size ?? option.least, b }]));
  const sized = column.flatMap((option, b) =>
    option.empty || option.size === null ? [] : [{ size: option.size, soft: option.soft, b }],
  );
  const hard = sized.filter(({ soft }) => group.objective.plain || !soft);
  const firm = hard.length ? hard : sized;
  const largest = reach.reduce((a, c) => (c.size > a.size || (c.size === a.size && c.b > a.b) ? c : a));
  const least = firm.reduce((a, c) => (c.size < a.size || (c.size === a.size && c.b < a.b) ? c : a));
  const bands = [...new Set([largest.b, least.b])].sort((a, c) => a - c);
  const text = () => {
    const sides = bands.map((b) => {
      const option = column[b] as Option;
      const names = option.letters.map((i) => letterName(letterAt(group, b, i))).join(" ");
      const size = option.size === null ? `at least ${brief(option.least)}` : brief(option.size);
      return `${names} (${size} m)`;
    });
    return `${sides.join(" and ")} differ by ${brief(omega)} m, more than μ = ${brief(group.tolerance)} m.`;
  };
  const letters = bands.flatMap((b) => (column[b]?.letters ?? []).map((i): [number, number] => [b, i]));
  return { constraint: "omega", bands, letters, text };
}

function covered(group: Group, column: readonly Option[]): Refusal | null {
  for (const [b, option] of column.entries()) {
    if (!option.guarded) continue;
    for (const o of group.guards[b] ?? []) {
      const other = column[o];
      if (!other?.soft) continue;
      const own = (band: number, wanted: (letter: LetterNote) => boolean) =>
        (column[band]?.letters ?? []).flatMap((i): [number, number][] =>
          wanted(letterAt(group, band, i)) ? [[band, i]] : [],
        );
      const below = own(b, (letter) => letter.unoccludable);
      const above = own(o, (letter) => !letter.opaque);
      const named = (list: [number, number][]) =>
        list.map(([band, i]) => letterName(letterAt(group, band, i))).join(" ");
      const text = () => `${named(below)} is unoccludable, and ${named(above)} above it is not opaque (C3).`;
      return {
        constraint: "C3",
        bands: [...new Set([b, o])].sort((x, y) => x - y),
        letters: [...below, ...above],
        text,
      };
    }
  }
  return null;
}

export interface Verdict extends Weight {
  /** The first constraint that is broken. */
  refusal: Refusal | null;
  /** Every one. */
  refusals: Refusal[];
}

/** Per band, the numbers of the letters in a column. */
export type Column = readonly (readonly number[])[];

/** A column of an alignment that somebody made up. */
export interface Step {
  /** Where it begins: positions of all bands, and whether no letter ended there. */
  state: number[];
  owed: boolean;
  options: Option[];
  /** What its elements break by themselves: C2, C4. */
  broken: Refusal[];
}

/**
 * Weight of each column of an alignment that somebody made up, and the constraints that it breaks. A letter that stands in
 * several columns is cut. Null where a word's letters are not all there in their order, or one is cut that may not be.
 * `size`: metres of an element as it is drawn, for those that C2 forbids, which hold what has a size and what has none.
 */
export function judge(
  group: Group,
  columns: readonly Column[],
  size?: (column: number, band: number) => number,
): Verdict[] | null {
  return (
    walk(group, columns)?.map(({ owed, options: own, broken }, j) => {
      const mixed = (option: Option) => option.size === null && !option.transparent && !option.empty;
      const options = own.map((option, b) => (size && mixed(option) ? { ...option, size: size(j, b) } : option));
      const all = [...broken, ...refusals(group, owed, options)];
      return { ...weigh(group, options), refusal: all[0] ?? null, refusals: all };
    }) ?? null
  );
}

/** Go through an alignment column by column; null as above. */
export function walk(group: Group, columns: readonly Column[]): Step[] | null {
  const steps: Step[] = [];
  let state = group.start;
  let owed = false;
  for (const [j, column] of columns.entries()) {
    const options: Option[] = [];
    const broken: Refusal[] = [];
    for (const [b, letters] of column.entries()) {
      const later = columns.slice(j + 1).find((own) => own[b]?.length)?.[b]?.[0];
      const cut = letters.length > 0 && later === letters.at(-1);
      const found = group
        .elements(b, state[b] ?? 0)
        .find(([option]) => same(option.letters, letters) && (!letters.length || ((option.target & 4) !== 0) === cut));
      if (!found) return null;
      options.push(found[0]);
      if (found[1]) broken.push(found[1]);
    }
    steps.push({ state, owed, options, broken });
    state = options.map((option) => option.target);
    owed = !options.some((option) => option.ends);
  }
  const whole = state.every((position, b) => position >> 2 === 2 * (group.bands[b]?.letters.length ?? 0));
  return whole ? steps : null;
}

/** A reason with its rows by their layers: the solver counts them. */
export const rowsNamed = (text: string, layers: readonly string[]): string =>
  text.replace(/\brow (\d+)\b/g, (whole, row) => (layers[row] === undefined ? whole : `“${layers[row]}”`));

function same(a: readonly number[], b: readonly number[]): boolean {
  return a.length === b.length && a.every((item, n) => item === b[n]);
}
