// A long list of rows of one height, of which only those in sight are in the page.

import { h } from "../shared/dom.ts";
import { afterDrawing, cancelFrame } from "./redraw.ts";

const AROUND = 8;

export interface Rows<T> {
  el: HTMLElement;
  /**
   * Show these items. Where they are others than before, or another one is spoken of now, the list scrolls to that one,
   * or to its top: what is in sight depends on the moment, not on where one came from.
   */
  set(items: readonly T[], now?: number): void;
  /** Bring an item into sight, within the list: the reader has picked it. */
  reveal(index: number): void;
}

/**
 * @param height of a row, in pixels; it may be another one whenever items are set
 * @param most rows that are in sight at once, likewise
 * @param key names an item, and all that its row depends on: while it is the same, the row stays
 * @param make makes the row of an item
 * @param drawn is called after rows were made
 */
export function rows<T>(
  options: {
    height: number;
    most: number;
    key: (item: T) => string;
    make: (item: T) => HTMLElement;
    drawn?: () => void;
  },
  signal: AbortSignal,
): Rows<T> {
  const { key, make } = options;
  const above = h("div", { "aria-hidden": "true" });
  const below = h("div", { "aria-hidden": "true" });
  const body = h("div", { role: "rowgroup" });
  const el = h("div", { class: "fnb-rows" }, above, body, below);
  let items: readonly T[] = [];
  let spoken = -1;
  let tall = 0;
  /** Where the list is scrolled to. The page is not asked for it: it would have to be laid out for that. */
  let top = 0;
  let window: [number, number] = [-1, -1];
  let drawn = new Map<string, HTMLElement>();

  const draw = () => {
    const first = Math.max(0, Math.floor(top / options.height) - AROUND);
    const last = Math.min(items.length, first + options.most + 2 * AROUND);
    window = [first, last];
    above.style.height = `${first * options.height}px`;
    below.style.height = `${(items.length - last) * options.height}px`;
    const next = new Map(items.slice(first, last).map((item) => [key(item), item]));
    for (const [name, row] of drawn) if (!next.has(name)) row.remove();
    let at = body.firstElementChild;
    drawn = new Map(
      [...next].map(([name, item]) => {
        const row = drawn.get(name) ?? make(item);
        if (row === at) at = row.nextElementSibling;
        else body.insertBefore(row, at);
        return [name, row];
      }),
    );
    options.drawn?.();
  };
  el.addEventListener(
    "scroll",
    () => {
      top = el.scrollTop;
      const first = Math.floor(top / options.height);
      const inside = first >= window[0] && Math.min(items.length, first + options.most) <= window[1];
      if (!inside) draw();
    },
    { signal },
  );
  const scroll = () => {
    if (!signal.aborted) el.scrollTop = top;
  };
  const go = (next: number) => {
    top = Math.max(0, Math.min(next, (items.length - Math.min(items.length, options.most)) * options.height));
    afterDrawing(scroll);
  };
  // A list that is not in the page cannot be scrolled: it is when it has come to stand there.
  const arrived = new ResizeObserver(scroll);
  arrived.observe(el);
  signal.addEventListener("abort", () => {
    arrived.disconnect();
    cancelFrame(scroll);
  });
  return {
    el,
    set(next, now = -1) {
      const moved = next.length !== items.length || now !== spoken || options.height !== tall;
      tall = options.height;
      items = next;
      spoken = now;
      const room = Math.min(items.length, options.most) * options.height;
      el.style.height = `${room}px`;
      el.setAttribute("aria-rowcount", String(items.length));
      if (moved) go(now < 0 ? 0 : (now + 0.5) * options.height - room / 2);
      draw();
    },
    reveal(index) {
      const room = Math.min(items.length, options.most) * options.height;
      const at = index * options.height;
      if (index < 0 || (at >= top && at + options.height <= top + room)) return;
      go(at + options.height / 2 - room / 2);
      draw();
    },
  };
}
