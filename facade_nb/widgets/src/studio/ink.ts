// The colours of a text that is typed in a field: the same letters over it, of which the field shows none. What is typed, the
// caret, selecting and undo stay the field's.

import { h, mark } from "../shared/dom.ts";
import { type Piece, partners, piecesOf } from "./grammar.ts";

/** So many signs are coloured; a longer text is plain. */
const MOST = 4000;

export interface InkOptions {
  pattern: string;
  /** The colour of a symbol. */
  colour(symbol: string): string;
}

export interface Fault {
  /** Where in the text it stands. */
  at: number;
  message: string;
}

export interface Ink {
  el: HTMLElement;
  /** Colour a text. */
  paint(text: string, faults: readonly Fault[], known: boolean): void;
  /** The letter at a point of the screen. */
  at(x: number, y: number): HTMLElement | null;
  /** Where a sign of the text stands on the screen. */
  place(offset: number): DOMRect;
  /** Follow a field that has scrolled its text. */
  scroll(top: number): void;
  /** Mark the brackets at the caret. */
  match(caret: number | null): void;
}

const CLASSES: Partial<Record<Piece["kind"], string>> = {
  empty: "fnb-ink-empty",
  counter: "fnb-ink-counter",
  number: "fnb-ink-number",
  operator: "fnb-ink-operator",
  mirror: "fnb-ink-mirror",
  bracket: "fnb-ink-bracket",
  assign: "fnb-ink-assign",
  end: "fnb-ink-end",
  comment: "fnb-ink-comment",
};

export function inkOf({ pattern, colour }: InkOptions): Ink {
  const page = h("div", { class: "fnb-ink-page" });
  const el = h("div", { class: "fnb-ink fnb-code", "aria-hidden": "true" }, page);
  let letters: HTMLElement[] = [];
  let brackets = new Map<number, HTMLElement>();
  let pairs = new Map<number, number>();
  return {
    el,
    paint(text, faults, known) {
      mark(el, "data-plain", text.length > MOST);
      letters = [];
      brackets = new Map();
      if (text.length > MOST) {
        page.replaceChildren();
        return;
      }
      const pieces = piecesOf(text);
      pairs = partners(pieces, text);
      const wrong = new Map(faults.map(({ at, message }) => [at, message]));
      const spans = pieces.map((piece) => {
        const { kind, start, end, name } = piece;
        const fault = [...wrong].find(([at]) => at >= start && at < end);
        const span = h("span", { class: CLASSES[kind] }, text.slice(start, end));
        if (fault) {
          mark(span, "data-fault", true);
          wrong.delete(fault[0]);
        }
        if (kind === "symbol") {
          span.style.setProperty("--fnb-tint", colour(name));
          mark(span, "data-letter", name);
          mark(span, "data-pattern", pattern);
          if (known) mark(span, "data-place", String(start));
          letters.push(span);
        }
        if (kind === "bracket") {
          brackets.set(start, span);
          if (!pairs.has(start)) mark(span, "data-alone", true);
        }
        return span;
      });
      // A fault at the end has nothing that stands there: a blank is underlined.
      const end = wrong.size > 0 ? h("span", { "data-fault": true }, " ") : null;
      page.replaceChildren(...spans, ...(end ? [end] : []), "\u200b");
    },
    at(x, y) {
      const within = (box: DOMRect) => x >= box.left && x < box.right && y >= box.top && y < box.bottom;
      return letters.find((letter) => [...letter.getClientRects()].some(within)) ?? null;
    },
    place(offset) {
      let left = offset;
      for (const node of page.childNodes) {
        const length = node.textContent?.length ?? 0;
        const text = node instanceof HTMLElement ? node.firstChild : node;
        if (left <= length && text) {
          const range = document.createRange();
          range.setStart(text, Math.min(left, text.textContent?.length ?? 0));
          const box = range.getBoundingClientRect();
          if (box.height > 0) return box;
        }
        left -= length;
        if (left < 0) break;
      }
      return el.getBoundingClientRect();
    },
    scroll(top) {
      page.style.transform = top > 0 ? `translateY(${-top}px)` : "";
    },
    match(caret) {
      const own = caret === null ? undefined : [caret - 1, caret].find((at) => pairs.has(at));
      const pair = own === undefined ? [] : [own, pairs.get(own)];
      for (const [at, span] of brackets) mark(span, "data-matched", pair.includes(at));
    },
  };
}
