// The least-squares system of an axis, and where its solution stands at a moment (the paper's 5.3, supplement 3.4, 3.5).

import { linked, target } from "../links.ts";
import type { PathNote } from "../network/story.ts";
import type { Axis } from "../timeline.ts";

export interface Meaning {
  kind: "size" | "boundary" | "start" | "end";
  symbol: string;
  group: number;
  band: number;
  column: number;
  place: number;
}

export interface SystemPosed {
  event: "SystemPosed";
  at: number;
  axis: Axis;
  variables: string[];
  meaning: Meaning[];
  rows: string[];
  entries: [number, number, number][];
  lower: (number | null)[];
  upper: (number | null)[];
  weight: number[];
  target: number[];
  pull: number[];
}

export interface ActiveSetStep {
  event: "ActiveSetStep";
  at: number;
  axis: Axis;
  round: number;
  step: number;
  entered: number[];
  left: number[];
  active: number;
  objective: number;
  violation: number;
  values: number[];
}

export interface SystemSolved {
  event: "SystemSolved";
  at: number;
  axis: Axis;
  solution: number[];
  multipliers: number[];
  placed: number[];
  deviation: number;
  iterations: number;
}

export type SizingEvent = SystemPosed | ActiveSetStep | SystemSolved;

const FREE = 1e29;
const TINY = 1e-9;

/** A letter, or a piece of one: the paper's `ijk`, from 0, and the group's number. */
export interface Place {
  group: number;
  band: number;
  column: number;
  place: number;
}

/** A constraint: a row of the system, or the bound of a variable. */
export interface Constraint {
  /** Counted as the bounds are: variables first, then rows. */
  number: number;
  name: string;
  kind: "=" | "≤";
  terms: [number, number][];
  lower: number | null;
  upper: number | null;
  /** What it says, in the paper's names. */
  text: string;
  /** Letters that it is about. */
  places: Place[];
  symbol: string;
}

/** What holds at a moment. */
export interface Moment {
  posed: boolean;
  step: ActiveSetStep | undefined;
  solved: SystemSolved | undefined;
  values: number[];
  active: Set<number>;
  /** What the objective adds up to, m². */
  objective: number;
}

export class System {
  readonly constraints: Constraint[];
  readonly steps: ActiveSetStep[];
  readonly solved: SystemSolved | undefined;
  readonly count: number;

  constructor(
    readonly posed: SystemPosed,
    events: readonly SizingEvent[],
    readonly paths: readonly PathNote[],
  ) {
    const own = events.filter((event) => event.axis === posed.axis);
    this.steps = own.filter((event): event is ActiveSetStep => event.event === "ActiveSetStep");
    this.solved = own.findLast((event): event is SystemSolved => event.event === "SystemSolved");
    this.count = posed.variables.length;
    const terms: [number, number][][] = posed.rows.map(() => []);
    for (const [row, variable, value] of posed.entries) terms[row]?.push([variable, value]);
    const bounds = posed.variables.flatMap((_, v) => this.bound(v));
    const rows = posed.rows.map((name, row) => this.row(name, row, terms[row] ?? []));
    const first = (kind: Constraint["kind"]) =>
      [rows, bounds].flatMap((list) => list.filter((own) => own.kind === kind));
    this.constraints = [...first("="), ...first("≤")];
  }

  /** What is known at a position. */
  at(position: number): Moment {
    const posed = this.posed.at <= position;
    const done = this.steps.filter((step) => step.at <= position);
    const step = done.at(-1);
    const active = new Set<number>();
    // Of the solution its sizes are spoken of, and so are the multipliers: those of the first round.
    const round = this.solved && this.solved.at <= position ? 1 : step?.round;
    for (const own of done) {
      if (own.round !== round) continue;
      for (const number of own.entered) active.add(number);
      for (const number of own.left) active.delete(number);
    }
    const solved = this.solved && this.solved.at <= position ? this.solved : undefined;
    const values = solved?.placed ?? step?.values ?? this.posed.target;
    const { weight, target: wanted } = this.posed;
    const objective = weight.reduce((sum, w, v) => sum + w * ((values[v] ?? 0) - (wanted[v] ?? 0)) ** 2, 0);
    return { posed, step, solved, values, active, objective };
  }

  multiplier(number: number, moment: Moment): number {
    return moment.solved?.multipliers[number] ?? 0;
  }

  /** The row that gives a letter its symbol's size. */
  rowOf(place: Place): Constraint | undefined {
    return this.byPlace.get(spell(place));
  }

  private get byPlace(): Map<string, Constraint> {
    if (!this.places) {
      this.places = new Map();
      for (const own of this.constraints)
        if (own.number >= this.count && own.kind === "=" && own.symbol)
          for (const place of own.places) this.places.set(spell(place), own);
    }
    return this.places;
  }
  private places: Map<string, Constraint> | null = null;

  /** The variables of a letter's two bounds. */
  boundsOf({ group, band, column, place }: Place): [number, number] {
    const { meaning } = this.posed;
    const find = (kind: Meaning["kind"], c: number, k: number) =>
      meaning.findIndex(
        (own) =>
          own.kind === kind &&
          own.group === group &&
          own.column === c &&
          (kind === "boundary" || (own.band === band && own.place === k)),
      );
    const start = find("start", column, place);
    const before = place > 0 ? find("end", column, place - 1) : -1;
    const end = find("end", column, place);
    return [
      start >= 0 ? start : before >= 0 ? before : find("boundary", column, -1),
      end >= 0 ? end : find("boundary", column + 1, -1),
    ];
  }

  /** The name of a letter as the paper's Figure 7 writes it: word, column, letter, counted from 1. */
  ijk({ band, column, place }: Place): string {
    return `${band + 1}-${column + 1}-${place + 1}`;
  }

  /** What a text is about where there are several groups. */
  private of(group: number | undefined, text: string): string {
    const name = group !== undefined && group >= 0 && this.paths.length > 1 ? this.paths[group]?.group : undefined;
    return name === undefined ? text : `${name}: ${text}`;
  }

  /** The name of a variable; with its group where it is to stand alone. */
  variableName(v: number, alone = false): string {
    const own = this.posed.meaning[v];
    if (!own) return "";
    if (own.kind === "size") return `|${own.symbol}|`;
    const name = own.kind === "boundary" ? `x${own.column}` : `${this.ijk(own)}.${own.kind === "start" ? "s" : "t"}`;
    return alone ? this.of(own.group, name) : name;
  }

  /** What a constraint is, and what it is about, for the links. */
  links(own: Constraint): Record<string, string | null> {
    const { axis } = this.posed;
    const is =
      own.number < this.count
        ? [target.variable(axis, this.posed.variables[own.number] ?? ""), target.row(axis, own.name)]
        : [target.row(axis, own.name)];
    const about = own.places.flatMap((place) => this.letterKeys(place));
    if (own.symbol) about.push(target.symbol(own.symbol));
    for (const [v] of own.terms) {
      const meaning = this.posed.meaning[v];
      about.push(target.variable(axis, this.posed.variables[v] ?? ""));
      if (meaning?.kind === "boundary" && !own.symbol)
        about.push(target.boundary(axis, this.paths[meaning.group]?.group ?? "", meaning.column));
    }
    return linked(is, [...new Set(about)]);
  }

  /** The letters of the layout that a place of the system stands for: one in every row that has the word. */
  letterKeys({ group, band, column, place }: Place): string[] {
    const path = this.paths[group];
    const letter = path?.columns[column]?.letters[band]?.[place];
    if (!path || letter === undefined) return [];
    return (path.bands[band]?.rows ?? []).map((row) => target.letter(path.axis, path.layers[row] ?? "", letter));
  }

  private bound(v: number): Constraint[] {
    const { meaning, variables } = this.posed;
    const [lower, upper] = [finite(this.posed.lower[v]), finite(this.posed.upper[v])];
    const own = meaning[v];
    const fixed = lower !== null && lower === upper;
    // Every inner boundary lies between 0 and the canvas: that says nothing that the rows do not.
    if (!own || (own.kind !== "size" && !fixed)) return [];
    const name = this.variableName(v);
    const parts = fixed
      ? `${name} = ${short(lower)}`
      : [lower === null ? "" : `${short(lower)} ≤ `, name, upper === null ? "" : ` ≤ ${short(upper)}`].join("");
    return [
      {
        number: v,
        name: variables[v] ?? "",
        kind: fixed ? "=" : "≤",
        terms: [[v, 1]],
        lower,
        upper,
        text: own.kind === "size" ? parts : this.of(own.group, parts),
        places: [],
        symbol: own.symbol,
      },
    ];
  }

  private row(name: string, row: number, terms: [number, number][]): Constraint {
    const number = this.count + row;
    const [lower, upper] = [finite(this.posed.lower[number]), finite(this.posed.upper[number])];
    const kind = lower !== null && lower === upper ? "=" : "≤";
    const places = [...name.matchAll(/(\d+):(\d+)-(\d+)-(\d+)/g)].map(
      ([, group, band, column, place]): Place => ({
        group: Number(group),
        band: Number(band),
        column: Number(column),
        place: Number(place),
      }),
    );
    const symbol = /= \|(.+)\|$/.exec(name)?.[1] ?? "";
    const boundary = this.posed.meaning[terms[0]?.[0] ?? -1];
    const group = places[0]?.group ?? (name.startsWith("extent") ? undefined : boundary?.group);
    return {
      number,
      name,
      kind,
      terms,
      lower,
      upper,
      text: this.of(group, this.say(name, places, symbol, terms)),
      places,
      symbol,
    };
  }

  private say(name: string, places: Place[], symbol: string, terms: [number, number][]): string {
    if (name.startsWith("extent of")) return `extent of the content of ${symbol} = |${symbol}|`;
    if (symbol) {
      const spans = places.map((place) => `${this.ijk(place)}.t − ${this.ijk(place)}.s`);
      return `${spans.length > 1 ? spans.map((span) => `(${span})`).join(" + ") : spans.join()} = |${symbol}|`;
    }
    const [first] = places;
    if (first && name.endsWith("gaps equal")) return `γ before ${this.ijk(first)} = γ after it`;
    if (first && name.includes("gap"))
      return `γ ${name.includes("before") ? "before" : "after"} ${this.ijk(first)} ≥ 0`;
    if (first) return `${this.ijk(first)}.s < ${this.ijk(first)}.t`;
    const [less, more] = [terms.find(([, value]) => value < 0), terms.find(([, value]) => value > 0)];
    return `${this.variableName(less?.[0] ?? -1)} < ${this.variableName(more?.[0] ?? -1)}`;
  }
}

/** The system of each axis that has one. */
export function systemsOf(events: readonly SizingEvent[], paths: readonly PathNote[]): Partial<Record<Axis, System>> {
  const found: Partial<Record<Axis, System>> = {};
  for (const axis of ["x", "y"] as const) {
    const posed = events.findLast((own): own is SystemPosed => own.event === "SystemPosed" && own.axis === axis);
    const own = paths.filter((path) => path.axis === axis);
    if (posed) found[axis] = new System(posed, events, own);
  }
  return found;
}

const spell = ({ group, band, column, place }: Place): string => `${group}:${band}-${column}-${place}`;
const finite = (value: number | null | undefined): number | null =>
  value === null || value === undefined || Math.abs(value) >= FREE ? null : value;
const short = (value: number | null): string => String(Number((value ?? 0).toPrecision(4)));

export interface Written {
  kind: "size" | "order" | "stitch" | "ends" | "column";
  text: string;
  places: Place[];
  symbol: string;
}

/** The constraints of a group written out letter by letter, as the supplement's Figure 7 lists them: ε is a letter, too. */
export function writtenOut(system: System, group: number): { objective: Written[]; constraints: Written[] } {
  const path = system.paths[group];
  if (!path) return { objective: [], constraints: [] };
  const prototypes = new Map<string, Place>();
  const objective: Written[] = [];
  const constraints: Written[] = [];
  const at = (band: number, column: number, place: number): Place => ({ group, band, column, place });
  const add = (kind: Written["kind"], text: string, places: Place[], symbol = "") =>
    constraints.push({ kind, text, places, symbol });
  const last = (band: number, column: number) => Math.max(0, (path.columns[column]?.letters[band]?.length ?? 0) - 1);
  const final = path.columns.length - 1;
  for (const [i, band] of path.bands.entries()) {
    add("ends", `${system.ijk(at(i, 0, 0))}.s = 0`, [at(i, 0, 0)]);
    for (const [j, column] of path.columns.entries()) {
      const own = column.letters[i] ?? [];
      if (j > 0) {
        const [before, here] = [at(i, j - 1, last(i, j - 1)), at(i, j, 0)];
        add("stitch", `${system.ijk(before)}.t = ${system.ijk(here)}.s`, [before, here]);
      }
      for (const [k, n] of own.entries()) {
        const here = at(i, j, k);
        const letter = band.letters[n];
        if (!letter) continue;
        add("order", `${system.ijk(here)}.s < ${system.ijk(here)}.t`, [here]);
        if (k > 0) add("stitch", `${system.ijk(at(i, j, k - 1))}.t = ${system.ijk(here)}.s`, [at(i, j, k - 1), here]);
        const pieces = path.columns.filter((other) => other.letters[i]?.includes(n)).length;
        if (pieces > 1) continue; // only all pieces together are as long as their symbol
        const prototype = prototypes.get(letter.symbol);
        const span = `${system.ijk(here)}.t − ${system.ijk(here)}.s`;
        if (prototype) {
          const of = `${system.ijk(prototype)}.t − ${system.ijk(prototype)}.s`;
          add("size", `${span} = ${of}`, [here, prototype], letter.symbol);
        } else {
          prototypes.set(letter.symbol, here);
          if (letter.size !== null)
            objective.push({
              kind: "size",
              text: `(${span} − ${short(letter.size)})²`,
              places: [here],
              symbol: letter.symbol,
            });
        }
      }
      if (i > 0) {
        const [here, top] = [at(i, j, 0), at(0, j, 0)];
        add("column", `${system.ijk(here)}.s = ${system.ijk(top)}.s`, [here, top]);
        const [end, other] = [at(i, j, last(i, j)), at(0, j, last(0, j))];
        add("column", `${system.ijk(end)}.t = ${system.ijk(other)}.t`, [end, other]);
      }
    }
    add("ends", `${system.ijk(at(i, final, last(i, final)))}.t = ${short(path.canvas)}`, [
      at(i, final, last(i, final)),
    ]);
  }
  return { objective, constraints };
}

export const isForce = (value: number): boolean => Math.abs(value) > TINY * 1000;
