// What can be asked of an alignment: where its next column ends, and what a boundary that was moved breaks.

import { formatNumber } from "../../shared/fields.ts";
import type { Truth } from "../../shared/quiz.ts";
import { nameOf } from "../letters.ts";
import type { PathNote } from "../network/story.ts";
import {
  type Column,
  EPS,
  type Group,
  judge,
  type Ledger,
  ledgerOf,
  type Option,
  refusal,
  rowsNamed,
  type Step,
  type Verdict,
  walk,
  weigh,
} from "../weights.ts";
import { atPreferred, type Cuts, choices, columnsOf, cutsOf, moved, sizeIn } from "./matrix.ts";

const WRONG = 4; // columns offered beside the right one
const MOVES = 2000; // boundaries that are tried

/** A boundary of one word was moved: what does that break? */
export interface Moved {
  path: PathNote;
  cuts: Cuts;
  boundary: number;
  band: number;
  /** Whether it went to the right. */
  right: boolean;
  verdicts: Verdict[];
  /** The width of the whole, metres. */
  width: number;
  /** What is broken, with the reasons. */
  broken: Map<string, string[]>;
}

/** Constraints in the order in which they are offered, and what each asks for. */
export const CONSTRAINTS: Record<string, string> = {
  omega: "ω ≤ μ: what stands in a column is about equally large",
  width: "|W − canvas| ≤ μ: the columns are as wide as the canvas, about",
  C1: "C1: an element that is empty, or not opaque, has opaque letters in another row",
  C2: "C2: an element is all transparent, or not at all",
  C3: "C3: what is not opaque does not stand before an unoccludable letter",
  C4: "C4: an attached letter at the end of its element has a neighbour in its row",
  boundary: "every boundary is a letter's end in some row",
};

/** Alignments in which one boundary of the solver's was moved: one of each kind first, one that breaks nothing last. */
export function movedCases(path: PathNote, group: Group, placements: Readonly<Record<string, string>>): Moved[] {
  const own = cutsOf(path);
  const kinds = new Map<string, Moved[]>();
  let tries = 0;
  for (let boundary = 1; boundary < own.places.length - 1; boundary++)
    for (const [band] of path.bands.entries())
      for (const place of choices(path, own, boundary, band)) {
        const was = own.places[boundary]?.[band] ?? 0;
        if (place === was || place & 1 || tries++ > MOVES) continue; // the width of a piece would be a guess
        const cuts = moved(own, boundary, band, place);
        const drawn = atPreferred(path, cuts, placements);
        const verdicts = judge(group, columnsOf(cuts), sizeIn(drawn));
        if (!verdicts) continue;
        const { width } = drawn;
        const broken = brokenBy(path, verdicts, width);
        if ([...broken.keys()].some((kind) => !(kind in CONSTRAINTS))) continue;
        const kind = [...broken.keys()].sort().join();
        const case_ = { path, cuts, boundary, band, right: place > was, verdicts, width, broken };
        kinds.set(kind, [...(kinds.get(kind) ?? []), case_]);
      }
  const order = [...kinds.keys()].sort((a, b) => b.length - a.length || a.localeCompare(b));
  const most = Math.max(0, ...[...kinds.values()].map((list) => list.length));
  const turn = (list: readonly Moved[], n: number) => list[(n * 7) % list.length] as Moved;
  return Array.from({ length: most }, (_, n) => order.map((kind) => turn(kinds.get(kind) ?? [], n))).flat();
}

function brokenBy(path: PathNote, verdicts: readonly Verdict[], width: number): Map<string, string[]> {
  const broken = new Map<string, string[]>();
  const add = (kind: string, why: string) =>
    broken.set(kind, [...(broken.get(kind) ?? []), rowsNamed(why, path.layers)]);
  for (const [j, { refusals }] of verdicts.entries())
    for (const own of refusals) add(own.constraint, `Column ${j + 1}: ${own.text()}`);
  const off = Math.abs(width - path.canvas);
  if (off > path.tolerance + EPS)
    add("width", `W = ${formatNumber(width)} m misses the canvas by ${formatNumber(off)} m, more than μ.`);
  return broken;
}

export function movedTruths({ path, broken, width }: Moved): Map<string, Truth> {
  const kept: Record<string, string> = {
    omega: `Kept: in no column do sizes differ by more than μ = ${formatNumber(path.tolerance)} m.`,
    width: `Kept: W = ${formatNumber(width)} m is within μ of ${formatNumber(path.canvas)} m.`,
    C1: "Kept: behind all that is empty or not opaque stand opaque letters.",
    C2: "Kept: no element mixes transparent letters with others.",
    C3: "Kept: nothing that is not opaque stands before an unoccludable letter.",
    C4: "Kept: no attached letter has lost its neighbour.",
    boundary: "Kept: every boundary is a letter's end in some row.",
  };
  return new Map(
    Object.keys(CONSTRAINTS).map((kind) => {
      const why = broken.get(kind);
      return [kind, { right: !!why, why: why ? why.join(" ") : (kept[kind] ?? "") }];
    }),
  );
}

export interface Offer extends Truth {
  column: Column;
  /** Per band: whether it ends within its last letter. */
  cut: boolean[];
  /** J of what is laid with it, metres. */
  cost: number;
}

/** The first columns are known: which is next? */
export interface Next {
  path: PathNote;
  column: number;
  /** The columns before it, and one with all that is left. */
  cuts: Cuts;
  offers: Map<string, Offer>;
}

/** Every column that can be asked for: those with the most different reasons first. */
export function nextCases(path: PathNote, group: Group): Next[] {
  const steps = walk(group, columnsOf(cutsOf(path)));
  if (!steps) return [];
  const whole = costOf(path, group);
  let before = 0;
  const found: { next: Next; reasons: number }[] = [];
  for (const [j, step] of steps.entries()) {
    const wrong = others(group, step, path, before, whole);
    before += weigh(group, step.options).cost;
    if (wrong.length < 2) continue;
    const own = path.columns[j];
    const why = `The solver's: ω = ${formatNumber(own?.omega)} m, ${formatNumber(own?.width)} m wide; no alignment that goes on otherwise is better.`;
    const all = [offerOf(step.options, before, true, why), ...wrong.map(({ offer }) => offer)];
    const named = all.map((offer) => [keyOf(path, offer), offer] as const).sort(([a], [b]) => a.localeCompare(b, "en"));
    const reasons = new Set(wrong.map(({ kind }) => kind)).size;
    found.push({ next: { path, column: j, cuts: upTo(path, j), offers: new Map(named) }, reasons });
  }
  return found.sort((a, b) => b.reasons - a.reasons).map(({ next }) => next);
}

/** J of the solver's alignment, with the sizes of its pieces. */
export function costOf(path: PathNote, group: Group): number {
  return ledgerOfPath(path, group).cost;
}

/** J of an alignment that was made, term by term, at the sizes that its pieces have got. */
export function ledgerOfPath(path: PathNote, group: Group): Ledger {
  const steps = walk(group, columnsOf(cutsOf(path))) ?? [];
  const columns = steps.map(({ options }, j) =>
    options.map((option, b) => ({
      ...option,
      size: option.size ?? (path.columns[j]?.sizes[b] ?? []).reduce((sum, size) => sum + size, 0),
    })),
  );
  return ledgerOf(
    group,
    columns.map((column) => weigh(group, column)),
    path.width,
  );
}

/** Columns that may not stand here, or with which every alignment costs more: nearest to the right one first. */
function others(group: Group, step: Step, path: PathNote, before: number, whole: number) {
  const found: { offer: Offer; kind: string; far: number }[] = [];
  const seen = new Set([keyOf(path, offerOf(step.options, before, true, ""))]);
  for (const [b, now] of step.options.entries())
    for (const [option, refused] of group.elements(b, step.state[b] ?? 0)) {
      const column = step.options.map((own, o) => (o === b ? option : own));
      const broken = refused ?? refusal(group, step.owed, column);
      const cost = before + weigh(group, column).cost;
      if (!broken && cost <= whole + 0.002) continue; // it may be as good, or looks so
      const why = broken
        ? rowsNamed(broken.text(), path.layers)
        : `ω = ${formatNumber(weigh(group, column).omega)} m: so far J is ${formatNumber(cost)} m already, and the solver's whole alignment costs ${formatNumber(whole)} m.`;
      const offer = offerOf(column, cost, false, why);
      const key = keyOf(path, offer);
      if (seen.has(key) || broken?.constraint === "empty") continue;
      seen.add(key);
      const far = Math.abs(option.target - now.target) + (option.empty !== now.empty ? 6 : 0);
      found.push({ offer, kind: broken?.constraint ?? "J", far });
    }
  found.sort((a, b) => a.far - b.far);
  const first = found.filter((own, n) => found.findIndex(({ kind }) => kind === own.kind) === n);
  return [...first, ...found.filter((own) => !first.includes(own))].slice(0, WRONG);
}

const offerOf = (options: readonly Option[], cost: number, right: boolean, why: string): Offer => ({
  cost,
  right,
  why,
  column: options.map(({ letters }) => letters),
  cut: options.map(({ target, empty }) => !empty && (target & 4) !== 0),
});

/** A column as text: the element of each row, ε where it is empty, … where its last letter goes on. */
export function elementText(path: PathNote, band: number, { column, cut }: Offer): string {
  const letters = (column[band] ?? []).flatMap((n) => path.bands[band]?.letters[n] ?? []);
  return letters.length ? letters.map(nameOf).join(" ") + (cut[band] ? " …" : "") : "ε";
}

const keyOf = (path: PathNote, offer: Offer): string =>
  path.bands.map((_, b) => elementText(path, b, offer)).join(" / ");

function upTo(path: PathNote, column: number): Cuts {
  const { places, filled } = cutsOf(path);
  const end = path.bands.map(({ letters }) => 2 * letters.length);
  const from = places[column] ?? [];
  const rest = end.map((last, b) => (from[b] ?? 0) < last);
  return { places: [...places.slice(0, column + 1), end], filled: [...filled.slice(0, column), rest] };
}
