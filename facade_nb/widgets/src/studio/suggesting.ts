// The list of completions under the caret of a field.

import { h, mark } from "../shared/dom.ts";
import { ofInputMethod } from "../shared/keys.ts";
import { placeUnder } from "../shared/placing.ts";
import { insert } from "../shared/writing.ts";
import { type Completion, comesByItself, type Item } from "./completion.ts";

export interface SuggestOptions {
  label: string;
  /** What may come at the caret. */
  complete(text: string, caret: number): Completion;
  colour(symbol: string): string;
  /** Where a sign of the text stands on the screen. */
  at(offset: number): DOMRect;
}

/**
 * A field whose text can be completed. Tab asks where a name is being written, and Ctrl+Space anywhere; arrows choose, Enter
 * and Tab take, Escape closes. A list that came by itself takes no Enter until an arrow has chosen.
 */
export function suggest(input: HTMLTextAreaElement, options: SuggestOptions, signal: AbortSignal): HTMLElement {
  const id = `fnb-${Math.random().toString(36).slice(2)}`;
  const list = h("div", { class: "fnb-suggest", role: "listbox", id, "aria-label": options.label, hidden: true });
  let now: Completion = { from: 0, to: 0, items: [] };
  let active = -1;
  /** After Escape, Tab leads on, as ever. */
  let left = false;
  mark(input, "aria-autocomplete", "list");
  mark(input, "aria-controls", id);
  mark(input, "aria-expanded", "false");

  // A list that stands still while the page moves under it belongs to nothing.
  const moved = ({ target }: Event) => {
    if (target instanceof Node && !list.contains(target) && target !== input) close();
  };
  const close = () => {
    if (list.hidden) return;
    list.hidden = true;
    window.removeEventListener("scroll", moved, true);
    mark(input, "aria-expanded", "false");
    mark(input, "aria-activedescendant", null);
  };
  const choose = (at: number) => {
    active = at;
    [...list.children].forEach((option, n) => {
      mark(option, "aria-selected", String(n === active));
      if (n === active) option.scrollIntoView?.({ block: "nearest" });
    });
    mark(input, "aria-activedescendant", active < 0 ? null : `${id}-${active}`);
  };
  const find = () => options.complete(input.value, input.selectionStart);
  const open = (found: Completion, first: number) => {
    now = found;
    if (now.items.length === 0 || input.readOnly) return close();
    list.replaceChildren(...now.items.map(optionOf));
    list.hidden = false;
    window.addEventListener("scroll", moved, { capture: true, signal });
    mark(input, "aria-expanded", "true");
    const from = options.at(now.from);
    placeUnder({ getBoundingClientRect: () => from }, list);
    choose(first);
  };
  const optionOf = (item: Item, n: number) => {
    const dot = h("span", { class: "fnb-tint" });
    dot.style.background = item.symbol === undefined ? "transparent" : options.colour(item.symbol);
    const option = h(
      "div",
      { class: "fnb-suggest-option", role: "option", id: `${id}-${n}`, "data-kind": item.kind },
      dot,
      h("b", {}, item.label),
      h("span", {}, item.means),
    );
    option.addEventListener("pointerdown", (event) => {
      event.preventDefault(); // the field keeps the focus
      take(n);
    });
    return option;
  };
  const take = (n: number) => {
    const item = now.items[n];
    if (!item) return;
    close();
    input.setSelectionRange(now.from, now.to);
    insert(input, item.text);
    close(); // what was written might have opened it again
  };

  input.addEventListener("input", (event) => {
    left = false;
    const typed = event instanceof InputEvent ? event.data : null;
    if (!list.hidden) {
      const found = find();
      if (found.from === now.from && found.items.length > 0) open(found, active < 0 ? -1 : 0);
      else close();
    }
    if (list.hidden && comesByItself(typed)) open(find(), -1);
  });
  input.addEventListener("blur", close);
  input.addEventListener("pointerdown", close);
  input.addEventListener("keydown", (event) => {
    if (ofInputMethod(event)) return;
    const taken = () => {
      event.preventDefault();
      event.stopPropagation();
    };
    const { key, shiftKey, ctrlKey, metaKey, altKey } = event;
    const plain = !shiftKey && !ctrlKey && !metaKey && !altKey;
    if (ctrlKey && key === " " && list.hidden) {
      taken();
      open(find(), 0);
      return;
    }
    if (list.hidden) {
      if (key !== "Tab" || !plain || left || input.selectionStart !== input.selectionEnd) return;
      const found = find();
      if (found.items.length === 0 || !isBegun(input.value, found, input.selectionStart)) return;
      taken();
      if (found.items.length === 1 && found.from < input.selectionStart) {
        now = found;
        take(0);
      } else open(found, 0);
      return;
    }
    const last = now.items.length - 1;
    const steps: Record<string, number> = {
      ArrowDown: active >= last ? 0 : active + 1,
      ArrowUp: active <= 0 ? last : active - 1,
      PageDown: Math.min(last, active + 6),
      PageUp: Math.max(0, active - 6),
    };
    const to = steps[key];
    if (plain && to !== undefined) {
      taken();
      choose(to);
    } else if (key === "Escape") {
      left = true;
      taken();
      close();
    } else if (plain && ((key === "Enter" && active >= 0) || key === "Tab")) {
      taken();
      take(Math.max(0, active));
    } else if (["Enter", "ArrowLeft", "ArrowRight", "Home", "End", "Tab"].includes(key)) close();
  });
  return list;
}

/** Whether a name, a count or a substitution is being written at the caret: then Tab completes it. */
function isBegun(text: string, { from }: Completion, caret: number): boolean {
  return from < caret || /\^[~|.:@·∘⊙]?[-−]?$/.test(text.slice(0, caret));
}
