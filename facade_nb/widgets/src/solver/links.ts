// What a view shows is named by targets, and everything that shows a target lights up when it is hovered anywhere.
//
// An element says what it is in `data-link` (it says so to others when it is hovered, and lights up when one of these
// is), and what it is about in `data-about` (it lights up for these too). Both are lists of keys, blanks between. With
// `data-pick` a click on anything within it picks it as a whole.

import { mark } from "../shared/dom.ts";
import type { Axis } from "./timeline.ts";

type Part = string | number;

const key = (kind: string, ...parts: Part[]): string =>
  [kind, ...parts.map((part) => encodeURIComponent(part))].join(":");

/** The vocabulary of targets. docs/visible.md lists it. */
export const target = {
  /** A symbol, wherever it stands. */
  symbol: (name: string) => key("symbol", name),
  counter: (name: string) => key("counter", name),
  pattern: (name: string) => key("pattern", name),
  layer: (name: string) => key("layer", name),
  /** A word of a pattern, by its text. */
  word: (axis: Axis, pattern: string, text: string) => key("word", axis, pattern, text),
  /** A candidate, by its number on its axis. */
  candidate: (axis: Axis, number: number) => key("candidate", axis, number),
  /** An equation of pattern analysis, by its number on its axis. */
  equation: (axis: Axis, number: number) => key("equation", axis, number),
  /** A node of a network: where each of its bands stands. */
  node: (axis: Axis, network: number, group: number, places: readonly number[]) =>
    key("node", axis, network, group, places.join(",")),
  /** An edge of a network: the node it leaves, and the letters of each band in its column. */
  edge: (
    axis: Axis,
    network: number,
    group: number,
    places: readonly number[],
    column: readonly (readonly number[] | null)[],
  ) => key("edge", axis, network, group, places.join(","), column.map((own) => own?.join(".") ?? "*").join(",")),
  /** A column of a group's alignment. */
  column: (axis: Axis, group: string, column: number) => key("column", axis, group, column),
  /** A boundary between columns: 0 is the start of the canvas. */
  boundary: (axis: Axis, group: string, boundary: number) => key("boundary", axis, group, boundary),
  /** A letter of the word in a layer's row, by its number in the word. */
  letter: (axis: Axis, layer: string, letter: number) => key("letter", axis, layer, letter),
  /** A row of the least-squares system, or a bound of a variable, by its name. */
  row: (axis: Axis, name: string) => key("row", axis, name),
  /** A variable of the least-squares system, by its name. */
  variable: (axis: Axis, name: string) => key("variable", axis, name),
  /** A shape of the façade, by its number in painting order. */
  shape: (number: number) => key("shape", number),
} as const;

export type TargetKind = keyof typeof target;

/** The attributes that link an element. */
export function linked(is: readonly string[], about: readonly string[] = []): Record<string, string | null> {
  return { "data-link": is.join(" ") || null, "data-about": about.join(" ") || null };
}

const tokens = (element: Element, name: string): string[] => element.getAttribute(name)?.split(" ") ?? [];

export class Links {
  private hovered: readonly string[] = [];
  private chosen: readonly string[];
  private readonly watchers = new Set<() => void>();
  /** Roots under which something may be marked: most steps of the player are taken while nothing is. */
  private readonly marked = new WeakSet<ParentNode>();

  constructor(picked: readonly string[]) {
    this.chosen = picked;
  }

  /** The targets under the pointer, or under the focus. */
  get lit(): ReadonlySet<string> {
    return new Set(this.hovered);
  }

  /** The targets that were picked by a click, and stay. */
  get picked(): ReadonlySet<string> {
    return new Set(this.chosen);
  }

  hover(targets: readonly string[]): void {
    if (same(targets, this.hovered)) return;
    this.hovered = targets;
    this.tell();
  }

  pick(targets: readonly string[]): void {
    if (same(targets, this.chosen)) return;
    this.chosen = targets;
    this.tell();
  }

  /** Call back when what is lit or picked has changed. */
  watch(callback: () => void, signal: AbortSignal): void {
    this.watchers.add(callback);
    signal.addEventListener("abort", () => this.watchers.delete(callback));
  }

  /** Tell what the pointer and the focus are on, and pick by a click, for all linked elements under a root. */
  listen(root: HTMLElement, signal: AbortSignal): void {
    const of = (event: Event) => (event.target instanceof Element ? event.target.closest("[data-link]") : null);
    const over = (event: Event) => {
      const element = of(event);
      this.hover(element && root.contains(element) ? tokens(element, "data-link") : []);
    };
    root.addEventListener("pointerover", over, { signal });
    root.addEventListener("pointerleave", () => this.hover([]), { signal });
    root.addEventListener("focusin", over, { signal });
    root.addEventListener("focusout", () => this.hover([]), { signal });
    root.addEventListener(
      "click",
      (event) => {
        const within = event.target instanceof Element ? event.target.closest("[data-pick]") : null;
        const element = within ?? of(event);
        const control = event.target instanceof Element && event.target.closest("button, input, select, a, summary");
        if (!element || control || event.defaultPrevented) return;
        this.toggle(tokens(element, "data-link"));
      },
      { signal },
    );
    root.addEventListener("keydown", (event) => event.key === "Escape" && this.pick([]), { signal });
  }

  /**
   * Pick these, or, where they are what is picked, nothing. A candidate stays chosen while other things are picked: what
   * is picked then is mostly its own.
   */
  toggle(targets: readonly string[]): void {
    if (targets.some(isCandidate)) {
      this.pick(targets.every((key) => this.chosen.includes(key)) ? [] : targets);
      return;
    }
    const kept = this.kept;
    this.pick(same([...kept, ...targets], this.chosen) ? kept : [...kept, ...targets]);
  }

  /** Let go of what is picked, but for the candidate that is chosen. */
  release(): void {
    this.pick(this.kept);
  }

  private get kept(): string[] {
    return this.chosen.some(isCandidate) ? this.chosen.filter((key) => isCandidate(key) || isWord(key)) : [];
  }

  /** Mark every linked element under a root that shows what is lit (`data-lit`) or picked (`data-chosen`). */
  apply(root: ParentNode): void {
    const [lit, picked] = [this.lit, this.picked];
    const none = !lit.size && !picked.size;
    if (none && !this.marked.has(root)) return;
    if (none) this.marked.delete(root);
    else this.marked.add(root);
    for (const element of root.querySelectorAll("[data-link], [data-about]")) {
      if (none && !element.hasAttribute("data-lit") && !element.hasAttribute("data-chosen")) continue;
      const is = tokens(element, "data-link");
      // What is picked as a whole is its first target; the others are its parts', which others may share.
      const own = element.hasAttribute("data-pick") ? is.slice(0, 1) : [...is, ...tokens(element, "data-about")];
      mark(element, "data-lit", lit.size > 0 && own.some((token) => lit.has(token)));
      mark(element, "data-chosen", picked.size > 0 && own.some((token) => picked.has(token)));
    }
  }

  private tell(): void {
    for (const watcher of [...this.watchers]) watcher();
  }
}

const isCandidate = (key: string): boolean => key.startsWith("candidate:");
const isWord = (key: string): boolean => key.startsWith("word:");

function same(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((item, n) => item === b[n]);
}
