// Hover links: what is pointed at in the façade, in a text, a table or a list is marked wherever else it is shown, in every
// part over the same design. All in the browser.

import { mark } from "../shared/dom.ts";
import { type Celled, type Place, samePlace } from "./places.ts";

/** What is pointed at: a layer, and symbols across and upwards; empty where it is none of them. */
export interface Pointed {
  layer: string;
  x: string;
  y: string;
  /** Places of patterns that the letters come from; none: not known, or all of that symbol are meant. */
  places: readonly Place[];
}

/** What links ask of a design. */
export interface Resolve {
  places(cell: Celled): Place[];
  /** The patterns of a layer. */
  patterns(layer: string): string[];
}

const NOTHING: Pointed = { layer: "", x: "", y: "", places: [] };
const NOBODY: Resolve = { places: () => [], patterns: () => [] };
const WHERE = "[data-shape], [data-symbol], [data-letter], [data-layer]";
const SHOWS = "[data-symbol], [data-letter], .fnb-layer[data-layer], .fnb-pattern[data-pattern]";

type Watcher = (pointed: Pointed, from: Element | null) => void;
interface Group {
  roots: Map<HTMLElement, Resolve>;
  watchers: Set<Watcher>;
  last: Pointed;
}
const groups = new Map<string, Group>();

function groupOf(key: string): Group {
  const group = groups.get(key) ?? { roots: new Map(), watchers: new Set(), last: NOTHING };
  groups.set(key, group);
  return group;
}

/** The place that a letter of a text or of a listed word says it comes from. */
export function placeOf({ pattern, place, axis, index }: DOMStringMap): Place | undefined {
  if (pattern === undefined || place === undefined) return undefined;
  return {
    pattern,
    offset: Number(place),
    axis: axis === "x" || axis === "y" ? axis : undefined,
    index: index === undefined ? undefined : Number(index),
  };
}

/** What an element stands for. A symbol alone may stand on either axis. */
export function pointedAt(target: EventTarget | null, resolve = NOBODY): Pointed {
  const el = target instanceof Element ? target.closest<HTMLElement | SVGElement>(WHERE) : null;
  if (!el) return NOTHING;
  const { shape, layer, x, y, symbol, letter, number } = el.dataset;
  if (shape !== undefined)
    return { layer: layer ?? "", x: x ?? "", y: y ?? "", places: resolve.places({ layer, x, y, number }) };
  const name = symbol ?? letter;
  if (!name) return { ...NOTHING, layer: layer ?? "" };
  const place = placeOf(el.dataset);
  return { layer: "", x: name, y: name, places: place ? [place] : [] };
}

/** Whether a shape is what is pointed at, or belongs to it. */
export function belongs(shape: Celled, to: Pointed, resolve = NOBODY): boolean {
  if (to.layer && to.x) return shape.layer === to.layer && shape.x === to.x && shape.y === to.y;
  if (to.layer) return shape.layer === to.layer;
  if (to.places.length > 0) {
    const own = resolve.places(shape);
    return own.some((place) => to.places.some((other) => samePlace(place, other)));
  }
  return to.x !== "" && (shape.x === to.x || shape.y === to.y);
}

/** Mark in all parts of a design what is pointed at. */
export function point(key: string, pointed: Pointed, from: Element | null): void {
  const group = groupOf(key);
  const { last } = group;
  if (same(pointed, last)) return;
  group.last = pointed;
  for (const [root, resolve] of group.roots) light(root, pointed, resolve);
  for (const watcher of group.watchers) watcher(pointed, from);
}

function same(a: Pointed, b: Pointed): boolean {
  if (a.layer !== b.layer || a.x !== b.x || a.y !== b.y || a.places.length !== b.places.length) return false;
  return a.places.every((place, n) => {
    const other = b.places[n] as Place;
    return samePlace(place, other) && place.index === other.index && place.axis === other.axis;
  });
}

/** Have a part take part in the links of a design; `key` tells which one. */
export function link(root: HTMLElement, key: string, signal: AbortSignal, resolve = NOBODY): void {
  const group = groupOf(key);
  group.roots.set(root, resolve);
  root.addEventListener(
    "pointerover",
    (event) => {
      const target = event.target as Element;
      if (target.closest?.("[data-points]")) return; // it says itself what is pointed at in it
      point(key, pointedAt(target, resolve), target);
    },
    { signal },
  );
  root.addEventListener("pointerleave", () => point(key, NOTHING, null), { signal });
  signal.addEventListener("abort", () => {
    group.roots.delete(root);
    if (group.roots.size === 0) groups.delete(key);
  });
}

/** Be told what is pointed at in any part of a design. */
export function watchLinks(key: string, watcher: Watcher, signal: AbortSignal): void {
  const group = groupOf(key);
  group.watchers.add(watcher);
  signal.addEventListener("abort", () => group.watchers.delete(watcher));
}

/** Mark again in a part what is pointed at: some of it was made anew. */
export function relight(root: HTMLElement, key: string, resolve = NOBODY): void {
  const { last } = groupOf(key);
  if (last !== NOTHING) light(root, last, resolve);
}

/** Mark rows and letters that show what is pointed at; shapes are outlined by the façade itself. */
function light(root: HTMLElement, to: Pointed, resolve: Resolve): void {
  const patterns = to.layer ? resolve.patterns(to.layer) : to.places.map(({ pattern }) => pattern);
  for (const el of root.querySelectorAll<HTMLElement>(SHOWS)) {
    const { symbol, letter, layer, pattern } = el.dataset;
    const name = symbol ?? letter;
    const place = name === undefined ? undefined : placeOf(el.dataset);
    // Of letters that know their place, those are meant that come from it.
    const hit = place && to.places.length > 0 ? to.places.find((other) => samePlace(place, other)) : undefined;
    let lit: boolean;
    if (name !== undefined)
      lit = name !== "" && (name === to.x || name === to.y) && (!place || to.places.length === 0 || hit !== undefined);
    else if (layer !== undefined)
      lit =
        layer !== "" &&
        (to.layer === layer || (to.layer === "" && resolve.patterns(layer).some((own) => patterns.includes(own))));
    else lit = to.x === "" && to.layer !== "" && patterns.includes(pattern ?? "");
    mark(el, "data-lit", lit);
    if (!place) continue;
    // A letter of a word that was not chosen stands nowhere on the façade.
    if (place.axis !== undefined && place.index === undefined && hit?.index !== undefined) mark(el, "data-lit", false);
    const [n, of] = hit?.copy ?? [0, 0];
    mark(el, "data-copy", lit && place.axis === undefined && of > 1 ? `${n} of ${of}` : null);
  }
}
