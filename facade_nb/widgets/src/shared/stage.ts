// What Python describes besides the design and its elevation (facade_nb/widgets/studio/extras.py).

import type { Axis } from "./types.ts";

export type Rect = [number, number, number, number];

export interface AxisFacts {
  axis: Axis;
  cost: number;
  error: number;
  rest: number;
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
  kind: "beyond" | "hole" | "misalignment" | "occlusion" | "placement" | "sizing";
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
  naive: { shapes?: Rect[]; flaws?: Flaw[] };
  exploded: string;
  survey: { building?: string; openings?: Rect[]; score?: number; source?: string };
  snapshots: SnapshotState[];
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
  };
}
