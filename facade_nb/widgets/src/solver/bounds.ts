// Eq. 7: which words can fit, at any tolerance. The trace has the solver's verdicts at its own; here is the same rule for
// another, and for sampled sizes of unsized symbols, as the paper's Figure 7 lists them.

import type { LetterNote } from "./letters.ts";

const EPS = 1e-9;
const MOST = 60; // samples of one word

export interface WordEvent {
  at: number;
  pattern: string;
  word: string;
  size: number;
  counters: Record<string, number>;
  kept: boolean;
  reason: string;
  tolerance: number;
  low: number | null;
  high: number;
  choices: string[];
  letters: LetterNote[];
}

export interface GroupNote {
  name: string;
  layers: string[];
  patterns: string[];
}

/** A word, where its unsized symbols are sampled: one of its samples. */
export interface Candidate {
  event: WordEvent;
  /** Sizes of unsized symbols; empty where they are free. */
  sizes: Record<string, number>;
  size: number;
  reason: "fits" | "too long" | "too short" | "no partner" | "left out";
  /** By how many metres a bound of Eq. 7 is missed. */
  missed: number;
}

export interface Judged {
  low: number;
  high: number;
  /** Metres that opaque letters above can push aside. */
  push: number;
  words: Candidate[];
}

/** The patterns of an axis, those of the first group first, topmost first. */
export function inOrder(groups: readonly GroupNote[]): string[] {
  return [...new Set(groups.flatMap((group) => group.patterns))];
}

/**
 * Judge the words of an axis by Eq. 7.
 *
 * @param words those of each pattern
 * @param step samples unsized symbols at its multiples, as the paper does; null leaves them free
 */
export function judge(
  words: ReadonlyMap<string, readonly WordEvent[]>,
  groups: readonly GroupNote[],
  canvas: number,
  tolerance: number,
  step: number | null,
): Map<string, Judged> {
  const high = canvas + tolerance;
  const made = new Map<string, Judged>();
  // A pattern may stand in several groups: it is judged where least is above it, so the others must be known before.
  const pushes = new Map<string, number>();
  const opaque = new Map<string, number>();
  const settle = (pattern: string): number => {
    const known = opaque.get(pattern);
    if (known !== undefined) return known;
    opaque.set(pattern, 0); // a pattern's own word is not above itself
    let push = Number.POSITIVE_INFINITY;
    for (const group of groups) {
      const distinct = [...new Set(group.patterns)];
      const at = distinct.indexOf(pattern);
      if (at >= 0)
        push = Math.min(
          push,
          distinct.slice(0, at).reduce((sum, above) => sum + settle(above), 0),
        );
    }
    const room = Number.isFinite(push) ? push : 0;
    pushes.set(pattern, room);
    const low = canvas - tolerance - room;
    const own = (words.get(pattern) ?? []).flatMap((event) => sampled(event, low, high, step));
    made.set(pattern, { low, high, push: room, words: own });
    const most = Math.max(0, ...own.filter((word) => word.reason === "fits").map((word) => opaqueSize(word.event)));
    opaque.set(pattern, most);
    return most;
  };
  const order = inOrder(groups);
  for (const pattern of order) settle(pattern);
  partners([...made.values()]);
  return new Map(order.map((pattern) => [pattern, made.get(pattern) as Judged]));
}

function opaqueSize(event: WordEvent): number {
  return event.letters.reduce(
    (sum, letter) => sum + (letter.opaque && !letter.transparent ? (letter.size ?? 0) : 0),
    0,
  );
}

function sampled(event: WordEvent, low: number, high: number, step: number | null): Candidate[] {
  const unsized = [...new Set(event.letters.filter((letter) => letter.size === null).map((letter) => letter.symbol))];
  if (!unsized.length || step === null) return [verdict(event, {}, event.size, unsized.length > 0, low, high)];
  const times = unsized.map((name) => event.letters.filter((a) => a.symbol === name && a.size === null).length);
  const found: Candidate[] = [];
  const descend = (n: number, sizes: Record<string, number>, size: number) => {
    if (found.length >= MOST) return;
    if (n === unsized.length) {
      const made = verdict(event, sizes, size, false, low, high);
      if (made.reason === "fits") found.push(made);
      return;
    }
    const most = Math.floor((high - size + EPS) / ((times[n] ?? 1) * step));
    for (let multiple = most; multiple >= 1; multiple--) {
      const own = multiple * step;
      descend(n + 1, { ...sizes, [unsized[n] ?? ""]: own }, size + own * (times[n] ?? 1));
    }
  };
  descend(0, {}, event.size);
  if (found.length) return found;
  const least = Object.fromEntries(unsized.map((name) => [name, step]));
  const size = event.size + times.reduce((sum, n) => sum + n * step, 0);
  return [verdict(event, least, size, false, low, high)];
}

function verdict(
  event: WordEvent,
  sizes: Record<string, number>,
  size: number,
  free: boolean,
  low: number,
  high: number,
): Candidate {
  if (size > high + EPS) return { event, sizes, size, reason: "too long", missed: size - high };
  if (!free && size < low - EPS) return { event, sizes, size, reason: "too short", missed: low - size };
  return { event, sizes, size, reason: "fits", missed: 0 };
}

/** Two words can stand together where the counters and the sizes that they share are equal. */
function agree(a: Candidate, b: Candidate): boolean {
  return shared(a.event.counters, b.event.counters) && shared(a.sizes, b.sizes);
}

function shared(a: Record<string, number>, b: Record<string, number>): boolean {
  return Object.entries(a).every(([name, value]) => !(name in b) || Math.abs((b[name] ?? 0) - value) < EPS);
}

/** Words that fit, but find none in some other pattern that agrees with them, have no partner. */
function partners(all: readonly Judged[]): void {
  for (let changed = true; changed; ) {
    changed = false;
    for (const own of all)
      for (const word of own.words) {
        if (word.reason !== "fits") continue;
        const alone = all.some(
          (other) => other !== own && !other.words.some((mate) => mate.reason === "fits" && agree(word, mate)),
        );
        if (alone) {
          word.reason = "no partner";
          changed = true;
        }
      }
  }
}

/** The candidates that these words make: one word of each pattern, under one value of each counter. */
export function combined(judged: readonly Judged[], most: number): { tuples: Candidate[][]; more: boolean } {
  const tuples: Candidate[][] = [];
  let more = false;
  const descend = (n: number, taken: Candidate[]): boolean => {
    if (n === judged.length) {
      if (tuples.length >= most) {
        more = true;
        return false;
      }
      tuples.push(taken);
      return true;
    }
    for (const word of judged[n]?.words ?? []) {
      if (word.reason !== "fits" || !taken.every((other) => agree(other, word))) continue;
      if (!descend(n + 1, [...taken, word])) return false;
    }
    return true;
  };
  if (judged.length) descend(0, []);
  return { tuples, more };
}
