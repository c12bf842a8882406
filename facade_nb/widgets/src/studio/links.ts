// Hover links: what is pointed at in the façade, in a table or in a list is marked wherever else it is shown, in every part
// over the same design. All in the browser.

import { mark } from "../shared/dom.ts";

/** What is pointed at: a layer, and symbols across and upwards; empty where it is none of them. */
export interface Pointed {
  layer: string;
  x: string;
  y: string;
}

const NOTHING: Pointed = { layer: "", x: "", y: "" };
const WHERE = "[data-shape], [data-symbol], [data-letter], [data-layer]";

interface Group {
  roots: Set<HTMLElement>;
  watchers: Set<(pointed: Pointed, from: Element | null) => void>;
}
const groups = new Map<string, Group>();

function groupOf(key: string): Group {
  const group = groups.get(key) ?? { roots: new Set(), watchers: new Set() };
  groups.set(key, group);
  return group;
}

/** What an element stands for. A symbol alone may stand on either axis. */
export function pointedAt(target: EventTarget | null): Pointed {
  const el = target instanceof Element ? target.closest<HTMLElement | SVGElement>(WHERE) : null;
  if (!el) return NOTHING;
  const { shape, layer, x, y, symbol, letter } = el.dataset;
  if (shape !== undefined) return { layer: layer ?? "", x: x ?? "", y: y ?? "" };
  const name = symbol ?? letter;
  return name ? { layer: "", x: name, y: name } : { layer: layer ?? "", x: "", y: "" };
}

/** Whether a shape is what is pointed at, or belongs to it. */
export function belongs(shape: { layer?: string; x?: string; y?: string }, to: Pointed): boolean {
  if (to.layer && to.x) return shape.layer === to.layer && shape.x === to.x && shape.y === to.y;
  if (to.layer) return shape.layer === to.layer;
  return to.x !== "" && (shape.x === to.x || shape.y === to.y);
}

/** Have a part take part in the links of a design; `key` tells which one. */
export function link(root: HTMLElement, key: string, signal: AbortSignal): void {
  const group = groupOf(key);
  group.roots.add(root);
  let last = NOTHING;
  const point = (pointed: Pointed, from: Element | null) => {
    if (pointed.layer === last.layer && pointed.x === last.x && pointed.y === last.y) return;
    last = pointed;
    for (const each of group.roots) light(each, pointed);
    for (const watcher of group.watchers) watcher(pointed, from);
  };
  root.addEventListener("pointerover", (event) => point(pointedAt(event.target), event.target as Element), { signal });
  root.addEventListener("pointerleave", () => point(NOTHING, null), { signal });
  signal.addEventListener("abort", () => {
    group.roots.delete(root);
    if (group.roots.size === 0) groups.delete(key);
  });
}

/** Be told what is pointed at in any part of a design. */
export function watchLinks(
  key: string,
  watcher: (pointed: Pointed, from: Element | null) => void,
  signal: AbortSignal,
): void {
  const group = groupOf(key);
  group.watchers.add(watcher);
  signal.addEventListener("abort", () => group.watchers.delete(watcher));
}

/** Mark rows and letters that show what is pointed at; shapes are outlined by the façade itself. */
function light(root: HTMLElement, { layer, x, y }: Pointed): void {
  for (const el of root.querySelectorAll<HTMLElement>("[data-symbol], [data-letter], .fnb-layer[data-layer]")) {
    const { symbol, letter, layer: own } = el.dataset;
    const name = symbol ?? letter;
    mark(
      el,
      "data-lit",
      name !== undefined ? name !== "" && (name === x || name === y) : layer !== "" && own === layer,
    );
  }
}
