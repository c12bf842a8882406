// How a network comes about, part by part: nodes, the automaton's steps between them, and the closure, in which each arc
// follows from an arc with one letter less and a step. Every part has its reason in words.

import { formatNumber } from "../../shared/fields.ts";
import { nameOf } from "../letters.ts";
import { rowsNamed } from "../weights.ts";
import type { Arc, Base } from "./scene.ts";
import { restOf, type Subject } from "./story.ts";

export interface Segment {
  from: number[];
  to: number[];
  /** The word of which a letter is read. */
  band: number;
}

export type Part =
  | { kind: "node"; places: number[] }
  | { kind: "step"; segment: Segment }
  | { kind: "arc"; arc: Arc; parent: Arc | null; step: Segment | null }
  | { kind: "end" };

/** What stands after so many parts. */
export interface Built {
  nodes: ReadonlySet<string>;
  segments: readonly Segment[];
  arcs: readonly Arc[];
  now: Part;
  /** Whether nodes on no way to the end are told apart. */
  done: boolean;
}

const sum = (places: readonly number[]): number => places.reduce((all, own) => all + own, 0);
const inOrder = (a: readonly number[], b: readonly number[]): number => sum(a) - sum(b) || (a[0] ?? 0) - (b[0] ?? 0);
const lettersOf = (arc: Arc): number => arc.column.reduce((all, own) => all + (own?.length ?? 0), 0);

/** The parts of a lattice in the order in which they come about; none where it is not known as a whole. */
export function partsOf(subject: Subject, base: Base): Part[] {
  if (!base.lattice) return [];
  const whole = base.lattice.nodes.map(({ places }) => places);
  const places = [...new Map(whole.map((own) => [own.join(), own])).values()].sort(inOrder);
  const known = new Set(places.map((own) => own.join()));
  const segments = places.flatMap((from) => stepsFrom(subject, from, known));
  const arcs = base.arcs
    .filter(({ column, to }) => column.some((own) => own?.length) && known.has(to.join()))
    .sort((a, b) => lettersOf(a) - lettersOf(b) || inOrder(a.from, b.from) || inOrder(a.to, b.to));
  const into = new Map<string, Segment[]>();
  for (const own of segments) into.set(own.to.join(), [...(into.get(own.to.join()) ?? []), own]);
  const byEnds = new Map(arcs.map((arc) => [endsOf(arc.from, arc.to), arc]));
  return [
    ...places.map((own): Part => ({ kind: "node", places: own })),
    ...segments.map((segment): Part => ({ kind: "step", segment })),
    ...arcs.map((arc): Part => ({ kind: "arc", arc, ...cause(arc, into.get(arc.to.join()) ?? [], byEnds) })),
    { kind: "end" },
  ];
}

const endsOf = (from: readonly number[], to: readonly number[]): string => `${from.join()}>${to.join()}`;

/** One letter of one word is read, or the rest of one that is cut, or as much of it as goes before a cut. */
function stepsFrom(subject: Subject, from: number[], known: ReadonlySet<string>): Segment[] {
  return subject.bands.flatMap(({ letters }, band) => {
    const at = from[band] ?? 0;
    return [at + 1, (at & ~1) + 2].flatMap((next, n): Segment[] => {
      if (next > 2 * letters.length || (n === 0 && !(next & 1))) return [];
      const to = from.map((place, b) => (b === band ? next : place));
      return known.has(to.join()) ? [{ from, to, band }] : [];
    });
  });
}

/** The arc with one letter less, and the step behind it, that an arc follows from; the last letter may be of either word. */
function cause(arc: Arc, last: readonly Segment[], byEnds: ReadonlyMap<string, Arc>) {
  for (const step of last) {
    if (step.from.join() === arc.from.join()) return { parent: null, step };
    const parent = byEnds.get(endsOf(arc.from, step.from));
    if (parent && lettersOf(parent) < lettersOf(arc)) return { parent, step };
  }
  return { parent: null, step: null };
}

/** What stands when the parts up to a number have come. */
export function builtUp(parts: readonly Part[], count: number): Built {
  const so = parts.slice(0, Math.max(1, count));
  return {
    nodes: new Set(so.flatMap((own) => (own.kind === "node" ? [own.places.join()] : []))),
    segments: so.flatMap((own) => (own.kind === "step" ? [own.segment] : [])),
    arcs: so.flatMap((own) => (own.kind === "arc" ? [own.arc] : [])),
    now: so.at(-1) ?? { kind: "end" },
    done: so.at(-1)?.kind === "end",
  };
}

/** A part in words, with its reason. */
export function tell(subject: Subject, base: Base, part: Part): string {
  const layers = subject.path?.layers ?? subject.layers ?? [];
  const word = (band: number) => layers[subject.bands[band]?.rows[0] ?? 0] ?? `word ${band + 1}`;
  const letter = (band: number, place: number) => {
    const own = subject.bands[band]?.letters[place >> 1];
    return own ? nameOf(own) : "";
  };
  switch (part.kind) {
    case "node": {
      const rests = subject.bands.map((band, b) => `${restOf(band, part.places[b] ?? 0) || "nothing"} of ${word(b)}`);
      const isCut = part.places.some((place) => place & 1);
      const within = isCut ? " It lies within a transparent letter, which may be cut." : "";
      if (!sum(part.places)) return `The first node: nothing is read. ${rests.join(" and ")} are left.`;
      return `A node is a boundary in both words. Here ${rests.join(" and ")} ${rests.length > 1 ? "are" : "is"} left.${within}`;
    }
    case "step": {
      const { from, to, band } = part.segment;
      const read = letter(band, Math.min(from[band] ?? 0, (to[band] ?? 1) - 1));
      const piece = ((from[band] ?? 0) | (to[band] ?? 0)) & 1 ? "a piece of " : "";
      return `A step of the automaton reads ${piece}${read} of ${word(band)}, and leaves the other word as it is.`;
    }
    case "arc":
      return `${causeText(part, subject, word, letter)} ${standing(part.arc, layers)}`;
    case "end": {
      const faint = new Set(base.lattice?.nodes.map(({ places }) => places.join()));
      for (const key of base.alive) faint.delete(key);
      const none = faint.size ? ` ${faint.size} nodes are on no way of permitted arcs, and faint.` : "";
      return `That is the whole network: every path to the last node is an alignment, the cheapest is looked for.${none}`;
    }
  }
}

function causeText(
  { arc, parent, step }: Extract<Part, { kind: "arc" }>,
  subject: Subject,
  word: (band: number) => string,
  letter: (band: number, place: number) => string,
): string {
  const named = (own: Arc) =>
    own.column
      .map((letters, b) => letters?.map((n) => nameOf(subject.bands[b]?.letters[n] ?? NONE)).join("") || "ε")
      .join(" / ");
  const read = step ? `${letter(step.band, (step.to[step.band] ?? 1) - 1)} of ${word(step.band)}` : "";
  if (parent && step)
    return `${named(arc)} follows from ${named(parent)}, which is there, and the step that reads ${read}.`;
  if (step) return `${named(arc)} is one step: the other word has ε, an empty element, in this column.`;
  return `${named(arc)} is several steps one after the other: all that they read makes one column.`;
}

const NONE = { symbol: "", mirrored: false };

function standing(arc: Arc, layers: readonly string[]): string {
  if (arc.constraint) return `Forbidden: ${rowsNamed(arc.text, layers)}`;
  const omega = arc.omega === null ? "" : `, ω = ${formatNumber(arc.omega)} m`;
  return `Permitted: no constraint is against it${omega}.${arc.text ? ` ${arc.text}` : ""}`;
}
