// The field that a pattern's text is typed in: coloured as it is typed, with completions; its letters are linked with the
// façade.

import { h, mark } from "../shared/dom.ts";
import { codeField, draftOf, type Field } from "../shared/fields.ts";
import type { Store } from "../shared/store.ts";
import { type Context, tint } from "./common.ts";
import { completionsAt, type Known } from "./completion.ts";
import { type Fault, inkOf } from "./ink.ts";
import { point, pointedAt, relight } from "./links.ts";
import { isText, placesOf } from "./places.ts";
import { suggest } from "./suggesting.ts";

/** The field; what it needs to be told of stands in the store. */
export function patternField(
  { store, signal }: Context,
  name: string,
  options: { label: string; path: string[]; value: () => string; placeholder: string },
): Field & { input: HTMLTextAreaElement } {
  const { path } = options;
  const field = codeField(store, options);
  const { input } = field;
  const ink = inkOf({ pattern: name, colour: (symbol) => tint(store, symbol) });
  const list = suggest(
    input,
    {
      label: `Completions for pattern ${name}`,
      complete: (text, caret) => completionsAt(text, caret, knownTo(store, name)),
      colour: (symbol) => tint(store, symbol),
      at: ink.place,
    },
    signal,
  );
  const el = h("div", { class: "fnb-write" }, field.el, ink.el, list);
  mark(input, "data-points", true);

  let shown = "";
  const paint = () => {
    const text = input.value;
    const draft = draftOf(store, path);
    const own = draft && !store.pending(path) && String(draft.value ?? "") === text ? draft.faults : [];
    const faults = own.flatMap(({ line, column, message }): Fault[] =>
      line && column ? [{ at: offsetAt(text, line, column), message }] : [],
    );
    const known = isText(store, name, text);
    const symbols = store.get("design").symbols.map((symbol) => symbol.name);
    const key = JSON.stringify([text, faults, known, symbols]);
    if (key !== shown) {
      shown = key;
      ink.paint(text, faults, known);
      match();
      relight(el, store.prefix);
    }
    choose();
  };
  /** Mark the letters that the picked cell comes from. */
  const choose = () => {
    const { layer, x, y, number } = store.get("selection");
    const places = number ? placesOf(store, { layer, x, y, number: number.join(" ") }) : [];
    const own = new Set(places.filter(({ pattern }) => pattern === name).map(({ offset }) => String(offset)));
    for (const letter of ink.el.querySelectorAll<HTMLElement>("[data-letter]"))
      mark(letter, "data-chosen", letter.dataset.place !== undefined && own.has(letter.dataset.place));
  };
  const match = () => {
    const focus = input.matches(":focus") && input.selectionStart === input.selectionEnd;
    ink.match(focus ? input.selectionStart : null);
  };
  input.addEventListener("input", paint);
  for (const event of ["keyup", "pointerup", "focus", "blur"]) input.addEventListener(event, match);
  input.addEventListener("scroll", () => ink.scroll(input.scrollTop));
  // While an input method composes, the field shows its letters itself.
  input.addEventListener("compositionstart", () => mark(el, "data-composing", true));
  input.addEventListener("compositionend", () => mark(el, "data-composing", false));
  let over: HTMLElement | null = null;
  input.addEventListener("pointermove", (event) => {
    const letter = ink.at(event.clientX, event.clientY);
    if (letter === over) return;
    over = letter;
    point(store.prefix, pointedAt(letter), letter);
  });
  input.addEventListener("pointerleave", () => {
    over = null;
    point(store.prefix, pointedAt(null), null);
  });
  return {
    el,
    input,
    update() {
      field.update();
      paint();
    },
  };
}

/** Where a line and a column, both from 1, stand in a text; columns count whole characters. */
function offsetAt(text: string, line: number, column: number): number {
  const lines = text.split("\n");
  const before = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
  return before + [...(lines[line - 1] ?? "")].slice(0, column - 1).join("").length;
}

/** What may be written in a pattern. */
function knownTo(store: Store, name: string): Known {
  const { symbols, counters, patterns } = store.get("design");
  const axes = patterns.find((pattern) => pattern.name === name)?.axes ?? "";
  // Those of the same axis first.
  const near = (own: string) => Number(![...own].some((axis) => axes.includes(axis)));
  return {
    symbols: [...symbols].sort((a, b) => near(a.axes) - near(b.axes)),
    counters: counters.map(({ name, value, solved }) => ({
      name,
      told: value !== null ? `counter, fixed at ${value}` : `counter${solved === null ? "" : `, now ${solved}`}`,
    })),
    modes: store.get("catalogue").modes ?? [],
    patterns: patterns.filter((pattern) => pattern.name !== name),
  };
}
