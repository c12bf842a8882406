// A candidate that the reader has chosen, and that is not the layout: what the trace has of it, for all views. Its words are
// known; its columns where they were priced in a network that is told; sizes are told of the layout only.

import { formatNumber } from "../shared/fields.ts";
import { sizesOf } from "./align/matrix.ts";
import type { GroupNote, WordEvent } from "./bounds.ts";
import { type LetterNote, parsed } from "./letters.ts";
import { type Links, target } from "./links.ts";
import { lettersBetween, type NetworkData, type PathNote, WEIGHED } from "./network/story.ts";
import type { Axis, Timeline } from "./timeline.ts";
import { type BandNote, type Column, Group, judge, type Objective } from "./weights.ts";

export interface CandidateNote {
  event: "CandidateJudged";
  at: number;
  axis: Axis;
  number: number;
  words: Record<string, string>;
  counters: Record<string, number>;
  bound: number;
  floor: number | null;
  fate: string;
  cost: number | null;
  omega: number | null;
  columns: number | null;
  deviation: number | null;
  tolerance: number;
  networks: number[];
}

/** The pieces of a trace that say what a candidate is. */
interface Pieces {
  words: { events: ({ event: "AxisPosed"; axis: Axis; canvas: number; groups: GroupNote[] } | JudgedWord)[] };
  candidates: { events: CandidateNote[] };
  network: NetworkData;
}
type JudgedWord = { event: "WordJudged"; axis: Axis } & WordEvent;

/** A group of a candidate: its words in rows, and the columns that the solver found, or one for all that it did not. */
export interface Rows {
  path: PathNote;
  /** Whether the solver aligned it. */
  aligned: boolean;
  /** Number of its network in the piece `network`; -1: it is not told. */
  network: number;
}

export interface Alternative {
  note: CandidateNote;
  groups: Rows[];
  /** `Candidate 3 (k = 2)` */
  name: string;
  /** What became of it, in a sentence. */
  fate: string;
  /** Whether the solver has columns for all of it. */
  aligned: boolean;
}

export class Alternatives {
  private pieces: Pieces | null = null;
  private loading = false;
  private readonly made = new Map<CandidateNote, Alternative>();
  private readonly watchers = new Set<() => void>();
  private picked = "";
  /** Why what was chosen cannot be shown. */
  trouble = "";

  constructor(
    private readonly piece: <T>(name: string) => Promise<T>,
    private readonly timeline: Timeline,
    private readonly links: Links,
    signal: AbortSignal,
  ) {
    links.watch(() => this.look(), signal);
    this.look();
  }

  /** The axis of the candidate that is chosen, if one is. */
  get axis(): Axis | undefined {
    return this.picked ? (this.picked.split(":")[1] as Axis) : undefined;
  }

  /** What is chosen on an axis and is not the layout, once it is judged. */
  at(position: number, axis: Axis): Alternative | null {
    const note = this.note;
    if (!note || note.axis !== axis || note.at > position || note.fate === "best") return null;
    let own = this.made.get(note);
    if (!own) {
      own = alternative(note, this.pieces as Pieces, this.timeline);
      this.made.set(note, own);
    }
    return own;
  }

  /** Call back when something else is chosen, and what there is of it has come. */
  watch(callback: () => void, signal: AbortSignal): void {
    this.watchers.add(callback);
    signal.addEventListener("abort", () => this.watchers.delete(callback));
  }

  private get note(): CandidateNote | undefined {
    if (!this.picked) return undefined;
    return this.pieces?.candidates.events.find((own) => target.candidate(own.axis, own.number) === this.picked);
  }

  private look(): void {
    const picked = [...this.links.picked].find((key) => key.startsWith("candidate:")) ?? "";
    if (picked === this.picked) return;
    this.picked = picked;
    if (!picked || this.pieces) this.tell();
    else void this.load();
  }

  private async load(): Promise<void> {
    if (this.loading) return;
    this.loading = true;
    try {
      const [words, candidates, network] = await Promise.all([
        this.piece<Pieces["words"]>("words"),
        this.piece<Pieces["candidates"]>("candidates"),
        this.piece<NetworkData>("network"),
      ]);
      this.pieces = { words, candidates, network };
      this.trouble = "";
    } catch (error) {
      this.trouble = error instanceof Error ? error.message : String(error);
    }
    this.loading = false;
    this.tell();
  }

  /** A candidate is picked with its words, also where Python has named it alone. */
  private tell(): void {
    const { note, links } = this;
    const words = Object.entries(note?.words ?? {}).map(([name, word]) => target.word(note?.axis ?? "x", name, word));
    if (!words.every((key) => links.picked.has(key))) links.pick([...new Set([...links.picked, ...words])]);
    for (const watcher of [...this.watchers]) watcher();
  }
}

/** What has been proven of a candidate: J is at least that, by its sizes or by what the search has gone through. */
export const proven = ({ bound, floor }: Pick<CandidateNote, "bound" | "floor">): number => Math.max(bound, floor ?? 0);

function alternative(note: CandidateNote, pieces: Pieces, timeline: Timeline): Alternative {
  const { axis, number } = note;
  const posed = pieces.words.events.find((own) => own.event === "AxisPosed" && own.axis === axis);
  const groups = posed?.event === "AxisPosed" ? posed.groups : [];
  const letters = (pattern: string): LetterNote[] => {
    const word = note.words[pattern] ?? "";
    const told = pieces.words.events.find(
      (own) => own.event === "WordJudged" && own.axis === axis && own.pattern === pattern && own.word === word,
    );
    return told?.event === "WordJudged" ? told.letters : parsed(word);
  };
  const objective = timeline.data.objective as unknown as Objective;
  const rows = groups.map((group, n) => rowsOf(note, group, n, letters, pieces.network, timeline, objective));
  const values = Object.entries(note.counters).map(([name, value]) => `${name} = ${value}`);
  const best = pieces.candidates.events.find((own) => own.axis === axis && own.fate === "best");
  return {
    note,
    groups: rows,
    name: `Candidate ${number}${values.length ? ` (${values.join(", ")})` : ""}`,
    fate: fateOf(note, best),
    aligned: rows.every((own) => own.aligned),
  };
}

/** What became of a candidate, and why. */
export function fateOf(note: CandidateNote, best: CandidateNote | undefined): string {
  const metres = (value: number | null | undefined) => `${formatNumber(value ?? 0)} m`;
  const layout = best?.cost == null ? "" : ` against ${metres(best.cost)} of the layout`;
  const least = proven(note);
  switch (note.fate) {
    case "best":
      return "It is the layout.";
    case "tied":
      return `It was aligned and costs as little as the layout, J = ${metres(note.cost)}; that one has more columns, or deviates less.`;
    case "dearer":
      return `It was aligned and costs more, J = ${metres(note.cost)}${layout}.`;
    case "no alignment":
      return "It has no alignment: nothing keeps the tolerance and the constraints.";
    case "no sizes":
      return "It was aligned, but no sizes keep all bounds.";
    case "other axis":
      return "The other axis has nothing for its counters.";
    case "stopped":
      return "The search was cut short before it was decided.";
    default:
      return note.networks.length
        ? `It was begun and given up: J ≥ ${metres(least)} was proven${layout}.`
        : `It was dropped by its bound before it was aligned: its sizes alone make J ≥ ${metres(least)}${layout}.`;
  }
}

function rowsOf(
  note: CandidateNote,
  group: GroupNote,
  number: number,
  letters: (pattern: string) => LetterNote[],
  data: NetworkData,
  timeline: Timeline,
  objective: Objective,
): Rows {
  const words = bandsOf(group.patterns.map(letters));
  const canvas = timeline.data.canvas[note.axis];
  const same = (own: readonly BandNote[]) => alike(words, own);
  const network = data.networks.findIndex(
    (own) => own.axis === note.axis && note.networks.includes(own.network) && own.bands.some(same),
  );
  const told = data.networks[network];
  const inner = told ? told.bands.findIndex(same) : -1;
  // In its network the sizes that pattern analysis has found are known, too.
  const bands = words.map((own, b) => ({ ...own, letters: told?.bands[inner]?.[b]?.letters ?? own.letters }));
  const found = told && note.cost !== null ? cheapest(data, network, inner) : null;
  const { columns, after } = found ?? uncut(bands);
  const verdicts = judge(new Group(bands, canvas, note.tolerance, objective), columns) ?? [];
  const path: PathNote = {
    at: note.at,
    axis: note.axis,
    group: group.name,
    bands,
    columns: [],
    error: verdicts.reduce((sum, own) => sum + own.omega, 0),
    width: verdicts.reduce((sum, own) => sum + own.width, 0),
    network: told?.network ?? null,
    nodes: [],
    canvas,
    tolerance: note.tolerance,
    layers: group.layers,
    number: inner >= 0 ? inner : number,
  };
  const sizes = sizesOf({ ...path, bands: sized(bands, canvas, found?.unsized ?? {}) }, columns);
  path.columns = columns.map((own, j) => ({
    letters: own.map((each) => [...each]),
    after: after[j] ?? [],
    sizes: sizes[j] ?? [],
    width: verdicts[j]?.width ?? 0,
    omega: verdicts[j]?.omega ?? 0,
  }));
  return { path, aligned: found !== null, network };
}

/** Equal words of a group are one band, in the order of their first rows. */
export function bandsOf(rows: readonly LetterNote[][]): BandNote[] {
  const made = new Map<string, BandNote>();
  for (const [row, letters] of rows.entries()) {
    const key = JSON.stringify(letters.map((letter) => [letter.size, ...looks(letter)]));
    const own = made.get(key);
    if (own) own.rows.push(row);
    else made.set(key, { letters, rows: [row] });
  }
  return [...made.values()];
}

const looks = (a: LetterNote) => [a.symbol, a.transparent, a.opaque, a.attached, a.unoccludable, a.mirrored];

/** Whether a network's words are these; where a letter of these has no size, it may have one there. */
function alike(words: readonly BandNote[], others: readonly BandNote[]): boolean {
  if (words.length !== others.length) return false;
  return words.every(({ letters }, b) => {
    const other = others[b]?.letters ?? [];
    return (
      letters.length === other.length &&
      letters.every((a, n) => {
        const twin = other[n] as LetterNote;
        return looks(a).join() === looks(twin).join() && (a.size === null || a.size === twin.size);
      })
    );
  });
}

/** Letters without a size have what a price gave them, or an equal share of what their word leaves free. */
function sized(bands: readonly BandNote[], canvas: number, unsized: Readonly<Record<string, number>>): BandNote[] {
  return bands.map(({ letters, rows }) => {
    const open = letters.filter((a) => a.size === null && !(a.symbol in unsized)).length;
    const taken = letters.reduce((sum, a) => sum + (a.size ?? unsized[a.symbol] ?? 0), 0);
    const share = open ? Math.max(0, canvas - taken) / open : 0;
    return { rows, letters: letters.map((a) => ({ ...a, size: a.size ?? unsized[a.symbol] ?? share })) };
  });
}

/** All words in one column; a word alone needs no other to be cut: a column for each letter. */
function uncut(bands: readonly BandNote[]): { columns: Column[]; after: number[][] } {
  const [first] = bands;
  if (bands.length === 1 && first?.letters.length)
    return { columns: first.letters.map((_, n) => [[n]]), after: first.letters.map((_, n) => [2 * n + 2]) };
  return {
    columns: [bands.map(({ letters }) => letters.map((_, n) => n))],
    after: [bands.map(({ letters }) => 2 * letters.length)],
  };
}

interface Found {
  columns: Column[];
  after: number[][];
  unsized: Record<string, number>;
}

/** The cheapest alignment that was priced in a network, as far as its steps are told. */
function cheapest(data: NetworkData, network: number, group: number): Found | null {
  const own = data.networks[network];
  const priced = data.priced
    .filter((each) => own && each.axis === own.axis && each.network === own.network && each.path !== null)
    .sort((a, b) => (a.cost ?? 0) - (b.cost ?? 0) || b.columns - a.columns);
  const { steps } = data;
  const by = new Map<number, number>();
  for (let n = 0; n < steps.at.length; n++)
    if (steps.network[n] === network && steps.kind[n] === WEIGHED) by.set(steps.path[n] ?? -1, n);
  for (const each of priced) {
    const columns: Column[] = [];
    const after: number[][] = [];
    let at = each.path ?? -1;
    for (let step = by.get(at); step !== undefined; step = by.get(at)) {
      at = steps.parent[step] ?? -1;
      if (steps.group[step] !== group) continue;
      const [from, to] = [steps.offset[step] ?? 0, steps.offset[step + 1] ?? 0];
      columns.unshift(lettersAt(data, from, to));
      after.unshift(Array.from(steps.after.subarray(from, to)));
    }
    const ends = own?.bands[group]?.map(({ letters }) => 2 * letters.length).join();
    if (columns.length && after.at(-1)?.join() === ends && starts(columns))
      return { columns, after, unsized: each.unsized ?? {} };
  }
  return null;
}

function lettersAt({ steps }: NetworkData, from: number, to: number): Column {
  return Array.from({ length: to - from }, (_, b) => {
    const [before, after] = [steps.places[from + b] ?? 0, steps.after[from + b] ?? 0];
    return lettersBetween(before, after, steps.filled[from + b] === 1);
  });
}

/** Whether no step is missing: every word begins with its first letter. */
const starts = (columns: readonly Column[]): boolean =>
  (columns[0] ?? []).every((_, b) => (columns.find((own) => own[b]?.length)?.[b]?.[0] ?? 0) === 0);
