// The networks of a trace, and what the search has done in one of them at a moment.

import type { Alternative } from "../alternatives.ts";
import { nameOf } from "../letters.ts";
import type { Axis, Timeline } from "../timeline.ts";
import { played } from "../timeline.ts";
import type { BandNote } from "../weights.ts";

export interface NetworkNote {
  at: number;
  axis: Axis;
  network: number;
  names: string[];
  bands: BandNote[][];
  canvas: number;
  tolerance: number;
  search: string;
  closed: { at: number; nodes: number; bound: number | null; cut: boolean } | null;
}

export interface PathNote {
  at: number;
  axis: Axis;
  group: string;
  bands: BandNote[];
  columns: { letters: number[][]; after: number[]; sizes: number[][]; width: number; omega: number }[];
  error: number;
  width: number;
  network: number | null;
  nodes: number[];
  canvas: number;
  tolerance: number;
  layers: string[];
  /** Which group of its network it is in; -1 where that is not told. */
  number: number;
}

/** Steps of all networks, one after the other; `offset` says where the places of each begin (widgets/solver/networks.py). */
export interface Steps {
  at: Int32Array;
  network: Int16Array;
  kind: Uint8Array;
  group: Int16Array;
  fate: Uint8Array;
  text: Int32Array;
  way: Uint8Array;
  omega: Float64Array;
  cost: Float64Array;
  bound: Float64Array;
  /** What a pruned edge was held against. */
  against: Float64Array;
  path: Int32Array;
  parent: Int32Array;
  /** The path that makes a dropped one needless. */
  rival: Int32Array;
  offset: Int32Array;
  places: Int16Array;
  after: Int16Array;
  filled: Uint8Array;
  kinds: string[];
  fates: string[];
  texts: string[];
}

export interface RegionNote {
  at: number;
  axis: Axis;
  network: number;
  group: number;
  places: number[];
  words: [number, number];
  lower: [number, number][];
  upper: [number, number][];
  way: string;
}

export interface MergerNote {
  at: number;
  event: "PairsMerged" | "ControlsAligned";
  axis: Axis;
  network: number;
  cost: number | null;
  parts?: [number, number[], number[][]][];
  nodes?: [number, number[][]][];
}

/** A complete path that was priced; `path` is the number of its last edge. */
export interface PricedNote {
  at: number;
  axis: Axis;
  network: number;
  path: number | null;
  cost: number | null;
  columns: number;
  unsized: Record<string, number> | null;
}

/** A pass begins: nothing dearer than `limit` is followed, and `bound` has been proven. */
export interface LimitNote {
  at: number;
  axis: Axis;
  network: number;
  limit: number | null;
  bound: number | null;
}

export interface NetworkData {
  networks: NetworkNote[];
  priced: PricedNote[];
  limits: LimitNote[];
  steps: Steps;
  regions: RegionNote[];
  merged: MergerNote[];
  paths: PathNote[];
}

export const TAKEN = 0;
export const WEIGHED = 1;
export const REFUSED = 2;
export const MET = 3;
/** Reasons for which a permitted edge is not followed (solver/events/networks.py). */
export const PRUNED: readonly string[] = ["bound", "known", "best", "length"];

/** The network of one group. */
export interface Subject {
  key: string;
  axis: Axis;
  name: string;
  bands: BandNote[];
  canvas: number;
  tolerance: number;
  search: string;
  /** Number of the network, and of the group in it; -1 where the search in it is not told. */
  network: number;
  group: number;
  first: number;
  path: PathNote | null;
  /** Layers of its rows, where no path says them. */
  layers?: readonly string[];
  /** Its steps, by their numbers, and where in the trace each is told. */
  steps: Int32Array;
  at: Int32Array;
  /** The same of each kind: what is told up to a moment is the beginning of such a list, and is not listed again. */
  kinds: { steps: Int32Array; at: Int32Array }[];
}

/** What the search has done in a network up to a moment; steps by their numbers. */
export interface Told {
  taken: Int32Array;
  weighed: Int32Array;
  refused: Int32Array;
  /** The node that was taken up last; the step that is told right now. */
  current: number | undefined;
  now: number | undefined;
}

export class Story {
  readonly subjects: Subject[] = [];
  private readonly steps: Steps;

  constructor(
    readonly data: NetworkData,
    private readonly timeline: Timeline,
  ) {
    this.steps = data.steps;
    for (const [n, own] of data.networks.entries())
      for (const [group, bands] of own.bands.entries()) {
        const found = data.paths.find(
          (path) => path.axis === own.axis && path.network === own.network && path.number === group,
        );
        this.subjects.push({
          key: `${own.axis}:${own.network}:${group}`,
          axis: own.axis,
          name: found?.group ?? own.names[group] ?? String(group),
          bands,
          canvas: own.canvas,
          tolerance: own.tolerance,
          search: own.search,
          network: own.network,
          group,
          first: own.at,
          path: found ?? null,
          ...this.stepsOf(n, group),
        });
      }
    for (const path of data.paths)
      if (!this.subjects.some((own) => own.path === path))
        this.subjects.push({
          key: `${path.axis}:${path.group}`,
          axis: path.axis,
          name: path.group,
          bands: path.bands,
          canvas: path.canvas,
          tolerance: path.tolerance,
          search: timeline.data.search,
          network: -1,
          group: -1,
          first: path.at,
          path,
          ...this.stepsOf(-1, -1),
        });
  }

  private stepsOf(network: number, group: number): Pick<Subject, "steps" | "at" | "kinds"> {
    const found: number[] = [];
    for (let n = 0; n < this.steps.at.length; n++)
      if (this.steps.network[n] === network && this.steps.group[n] === group) found.push(n);
    const dated = (list: number[]) => ({
      steps: Int32Array.from(list),
      at: Int32Array.from(list, (n) => this.steps.at[n] ?? 0),
    });
    const kinds = [TAKEN, WEIGHED, REFUSED].map((kind) => dated(found.filter((n) => this.steps.kind[n] === kind)));
    return { ...dated(found), kinds };
  }

  /** The networks of a candidate that is not the layout: with what the search did in them, where that is told. */
  subjectsOf({ note, groups }: Alternative): Subject[] {
    return groups.map(({ path, aligned, network }, n) => {
      const told = this.data.networks[network];
      return {
        key: `${note.axis}:candidate ${note.number}:${n}`,
        axis: note.axis,
        name: path.group,
        bands: path.bands,
        canvas: path.canvas,
        tolerance: path.tolerance,
        search: told?.search ?? this.timeline.data.search,
        network: told ? told.network : -1,
        group: told ? path.number : -1,
        first: note.at,
        path: aligned ? path : null,
        layers: path.layers,
        ...this.stepsOf(told ? network : -1, path.number),
      };
    });
  }

  /** The network that is spoken of at a position; where several are chosen, the largest of the axis. */
  subjectAt(position: number): Subject | undefined {
    const axis = this.timeline.axisAt(position);
    const own = this.subjects.filter((subject) => subject.axis === axis);
    const here = own.find((subject) => subject.path?.at === position);
    if (here) return here;
    const largest = (list: Subject[]) =>
      list.reduce<Subject | undefined>((a, b) => (a && sizeOf(a) >= sizeOf(b) ? a : b), undefined);
    if (own.some((subject) => subject.path && subject.path.at <= position))
      return largest(own.filter((subject) => subject.path));
    let [found, last]: [Subject | undefined, number] = [undefined, -1];
    for (const subject of own) {
      const n = played(subject.at, position);
      const latest = n ? (subject.at[n - 1] ?? -1) : subject.first <= position ? subject.first : -1;
      if (latest > last) [found, last] = [subject, latest];
    }
    return found ?? largest(own.filter((subject) => subject.path)) ?? own[0];
  }

  /** What is told of a network at a position. */
  told(subject: Subject, position: number): Told {
    const upTo = (kind: number): Int32Array => {
      const own = subject.kinds[kind] as Subject["kinds"][number];
      return own.steps.subarray(0, played(own.at, position));
    };
    const [taken, weighed, refused] = [upTo(TAKEN), upTo(WEIGHED), upTo(REFUSED)];
    const seen = played(subject.at, position);
    const now = seen && subject.at[seen - 1] === position ? subject.steps[seen - 1] : undefined;
    return { taken, weighed, refused, current: taken.at(-1), now };
  }

  placesOf(step: number): number[] {
    return Array.from(this.steps.places.subarray(this.steps.offset[step], this.steps.offset[step + 1]));
  }

  /** Whether a step is of the node at some places. */
  isAt(step: number, places: readonly number[]): boolean {
    const from = this.steps.offset[step] ?? 0;
    if ((this.steps.offset[step + 1] ?? 0) - from !== places.length) return false;
    return places.every((place, b) => this.steps.places[from + b] === place);
  }

  /** Where a band stands at a step, and after it. */
  placeOf(step: number, band: number): number {
    return band < 0 ? 0 : (this.steps.places[(this.steps.offset[step] ?? 0) + band] ?? 0);
  }

  afterPlaceOf(step: number, band: number): number {
    const after = band < 0 ? 0 : (this.steps.after[(this.steps.offset[step] ?? 0) + band] ?? 0);
    return after < 0 ? this.placeOf(step, band) : after;
  }

  /** Where an edge leads, per band; null where that does not matter. */
  afterOf(step: number): (number | null)[] {
    return Array.from(this.steps.after.subarray(this.steps.offset[step], this.steps.offset[step + 1]), (place) =>
      place < 0 ? null : place,
    );
  }

  /** The letters of an edge's column, per band. */
  columnOf(step: number): (number[] | null)[] {
    const from = this.steps.offset[step] ?? 0;
    return this.afterOf(step).map((after, b) =>
      after === null
        ? null
        : lettersBetween(this.steps.places[from + b] ?? 0, after, this.steps.filled[from + b] === 1),
    );
  }

  /** The next step of a kind in a network, behind a position. */
  next(subject: Subject, position: number, kind: number): number | undefined {
    for (let k = played(subject.at, position); k < subject.steps.length; k++)
      if (this.steps.kind[subject.steps[k] as number] === kind) return subject.steps[k];
    return undefined;
  }

  reasonOf(step: number): string {
    return this.steps.fates[this.steps.fate[step] ?? 0] ?? "";
  }

  textOf(step: number): string {
    return this.steps.texts[this.steps.text[step] ?? 0] ?? "";
  }
}

/** Nodes of a lattice of whole letters: how large a network is. */
export const sizeOf = (subject: { bands: readonly BandNote[] }): number =>
  subject.bands.reduce((product, band) => product * (band.letters.length + 1), 1);

export function lettersBetween(from: number, to: number, filled = to > from): number[] {
  if (!filled) return [];
  const first = from >> 1;
  const behind = Math.max(first + 1, (to + 1) >> 1);
  return Array.from({ length: behind - first }, (_, n) => first + n);
}

/** What is still to come of a word at a place. */
export function restOf(band: BandNote, place: number): string {
  const rest = band.letters
    .slice(place >> 1)
    .map(nameOf)
    .join("");
  return place & 1 ? `…${rest}` : rest || "ε";
}
