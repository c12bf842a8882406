// What Python describes besides the design and its elevation (facade_nb/widgets/studio/extras.py).

import type { Axis } from "./types.ts";

export type Rect = [number, number, number, number];

export interface AxisFacts {
  axis: Axis;
  cost: number;
  error: number;
  /** E, Λ and the fit in metres, each with its price in J; null where they are not known. */
  terms: Record<"empty" | "loose" | "fit", [metres: number, price: number]> | null;
  gap: number;
  proven: boolean;
  deviation: number;
  groups: { name: string; error: number; columns: number }[];
}

/** What became of the design that is kept beside the notebook. */
export interface Keeping {
  state: "off" | "on" | "restored" | "offered" | "elsewhere" | "failed";
  name?: string;
  when?: string;
  reason?: string;
  file?: string;
}

/** A letter of a word: its symbol, where it begins and ends in metres, and whether it is transparent. */
export type MarkedLetter = [symbol: string, start: number, end: number, transparent: boolean];

export interface MarkedGroup {
  group: string;
  columns: number[];
  rows: { layer: string; pattern: string; letters: MarkedLetter[] }[];
}

export type Marks = Partial<Record<Axis, MarkedGroup[]>>;

export interface Flaw {
  kind: "beyond" | "hole" | "intrinsic" | "misalignment" | "occlusion" | "placement" | "short" | "sizing";
  rect: Rect;
  text: string;
}

export interface SnapshotState {
  number: number;
  name: string;
  svg: string;
  facts: AxisFacts[];
  shapes: number;
  canvas: { width: number; height: number };
}

/** The solved word of a pattern: its text, and of each letter where in it it comes from, and where it stands, metres. */
export interface SolvedLetters {
  text: string;
  letters: [symbol: string, offset: number, start: number, end: number, flags: string][];
}

export interface WordState {
  /** `place` is -1 where it is not known; flags: m, mirrored; t, transparent. */
  letters: [symbol: string, flags: string, place: number][];
  /** So many letters more are not told. */
  left: number;
  size: number;
  /** Whether it has a letter that takes what is left. */
  open: boolean;
  miss: number;
  reason: "chosen" | "fits" | "looser" | "too long" | "too short" | "range" | "left out" | "no partner";
  bound: string;
  counters: Record<string, number>;
}

export interface AxisWords {
  axis: Axis;
  canvas: number;
  low: number;
  high: number;
  words: WordState[];
  more: number;
}

/** The words that a pattern can make at this canvas, or a note that says why none are told. */
export interface PatternWords {
  text: string;
  axes: AxisWords[];
  note: string;
}

export interface StageState {
  /** The design as JSON text, for when there is no kernel to ask. */
  document: string;
  menus: { exports?: { key: string; title: string }[]; surveyed?: string[] };
  stage: {
    facts?: AxisFacts[];
    remedies?: { warning: number; text: string }[];
    limit?: number;
    keeping?: Keeping;
  };
  marks: Marks;
  /** Where shapes stand side by side, what is wrong there, and the shapes that the aligned layout has behind others. */
  naive: { shapes?: Rect[]; flaws?: Flaw[]; behind?: { before: number; rect: Rect }[]; drawing?: string };
  exploded: string;
  survey: { building?: string; openings?: Rect[]; score?: number; source?: string };
  snapshots: SnapshotState[];
  letters: Partial<Record<Axis, Record<string, SolvedLetters>>>;
  words: Record<string, PatternWords>;
}

/** A stage of which nothing was told yet. */
export function emptyStage(): StageState {
  return {
    document: "",
    menus: {},
    stage: {},
    marks: {},
    naive: {},
    exploded: "",
    survey: {},
    snapshots: [],
    letters: {},
    words: {},
  };
}
