// Fields that edit one place of the design. A field shows its draft where there is one, else the design's value, and is
// never written to while Python has not answered what was typed in it.

import { focused, h, mark, setText } from "./dom.ts";
import { type IconName, icon } from "./icons.ts";
import { historyKey } from "./keys.ts";
import { scrub } from "./scrub.ts";
import { type Range, stepByKeys } from "./stepping.ts";
import { keyOf, type Store } from "./store.ts";
import type { DraftState, Fault, Path } from "./types.ts";
import { write } from "./writing.ts";

export interface Field {
  el: HTMLElement;
  /** Show what holds now. */
  update(): void;
}

/** The draft of a field, if what was typed there is not part of the design. */
export function draftOf(store: Store, path: Path): DraftState | undefined {
  const key = keyOf(path);
  return store.get("drafts").find((draft) => keyOf(draft.path) === key);
}

export function formatNumber(value: number | null | undefined, digits = 3): string {
  return value === null || value === undefined ? "" : String(Number(value.toFixed(digits)));
}

interface TextOptions {
  label: string;
  path: Path;
  /** The value the design holds. */
  value: () => string;
  className?: string;
  placeholder?: string;
}

function showText(store: Store, input: HTMLInputElement | HTMLTextAreaElement, options: TextOptions): void {
  const draft = draftOf(store, options.path);
  mark(input, "aria-invalid", draft ? "true" : null);
  if (store.pending(options.path)) return;
  const text = String(store.unsent(options.path) ?? (draft ? (draft.value ?? "") : options.value()));
  if (input.value === text) return;
  // "6." and "6,0" mean what the design says: leave them be while they are being typed.
  const same = Number(input.value.replace(",", ".")) === Number(text) && input.value.trim() !== "" && text !== "";
  if (input.type === "text" && input.inputMode === "decimal" && same && focused(input) === input) return;
  write(input, text, store.undoing && focused(input) === input);
}

/** A number of metres, or a whole number; arrow keys step it. */
export function numberField(store: Store, options: TextOptions & Range & { min: number; start?: () => number }): Field {
  const input = h("input", {
    type: "text",
    inputmode: "decimal",
    class: `fnb-number ${options.className ?? ""}`,
    "aria-label": options.label,
    placeholder: options.placeholder,
    spellcheck: "false",
    autocomplete: "off",
  });
  const field = { el: input, update: () => showText(store, input, options) };
  input.addEventListener("input", () => store.set(options.path, input.value));
  input.addEventListener("blur", field.update);
  const start = () => Number(formatNumber(options.start?.() ?? options.min));
  stepByKeys(input, options, start);
  scrub(input, options, start);
  return field;
}

/** A pattern's text: one line that grows when lines are added or the text wraps. */
export function codeField(store: Store, options: TextOptions): Field & { input: HTMLTextAreaElement } {
  const input = h("textarea", {
    rows: 1,
    class: `fnb-code ${options.className ?? ""}`,
    "aria-label": options.label,
    placeholder: options.placeholder,
    spellcheck: "false",
    autocomplete: "off",
    autocapitalize: "off",
  });
  let grown = false;
  const grow = () => {
    grown = input.clientHeight > 0;
    const lines = input.value.split("\n").length;
    if (input.rows !== lines) input.rows = lines;
    // Long lines wrap: one row more than the text has lines, where it needs it.
    while (input.rows < 12 && input.clientHeight > 0 && input.scrollHeight > input.clientHeight + 2) input.rows += 1;
  };
  input.addEventListener("input", () => {
    grow();
    store.set(options.path, input.value);
  });
  return {
    el: input,
    input,
    update() {
      const before = input.value;
      showText(store, input, options);
      // Measuring forces a layout: only where there is something new to measure.
      if (input.value !== before || !grown) grow();
    },
  };
}

/** A name that is changed when the field is left or Enter is pressed; Escape brings the old one back. */
export function nameField(options: {
  label: string;
  value: () => string;
  commit: (name: string) => void;
  /** Where Enter leads. */
  next?: () => HTMLElement;
}): Field {
  const input = h("input", {
    type: "text",
    class: "fnb-name",
    "aria-label": options.label,
    spellcheck: "false",
    autocomplete: "off",
  });
  const commit = () => {
    if (input.readOnly) return; // what was typed while the kernel went stays
    const name = input.value.trim();
    if (name && name !== options.value()) options.commit(name);
    input.value = options.value();
  };
  input.addEventListener("blur", commit);
  input.addEventListener("keydown", (event) => {
    if (event.key !== "Enter") return;
    event.preventDefault(); // what gets the focus is not to be pressed, too
    const next = options.next?.();
    if (next) next.focus();
    else commit(); // left to nobody, the focus would fall to the host
  });
  holdBack(input, options.value);
  return {
    el: input,
    update() {
      if (focused(input) !== input && !input.readOnly) input.value = options.value();
      input.size = Math.max(2, options.value().length);
      mark(input, "title", options.value().length > 10 ? options.value() : null); // it may be cut
    },
  };
}

/** What is typed and not yet committed is part of no history but the field's own, and is given up by Escape. */
export function holdBack(input: HTMLInputElement, committed: () => string): void {
  input.addEventListener("keydown", (event) => {
    if (input.value === committed()) return;
    if (historyKey(event)) event.stopPropagation();
    if (event.key !== "Escape") return;
    event.preventDefault(); // nothing else is given up
    input.value = committed();
  });
}

/** A choice among names. */
export function choiceField(
  store: Store,
  options: { label: string; path: Path; value: () => string; choices: () => string[] },
): Field {
  const select = h("select", { class: "fnb-select", "aria-label": options.label });
  let shown = "";
  select.addEventListener("change", () => store.set(options.path, select.value));
  return {
    el: select,
    update() {
      const draft = draftOf(store, options.path);
      mark(select, "aria-invalid", draft ? "true" : null);
      const value = draft ? String(draft.value) : options.value();
      const choices = options.choices();
      const all = choices.includes(value) ? choices : [value, ...choices];
      if (all.join("\n") !== shown) {
        shown = all.join("\n");
        select.replaceChildren(...all.map((name) => h("option", { value: name }, name)));
      }
      if (!store.pending(options.path)) select.value = value;
    },
  };
}

/** A word that holds or does not. */
export function toggleField(
  store: Store,
  options: { label: string; title: string; path: Path; word: string; value: () => boolean },
): Field {
  const button = h(
    "button",
    { type: "button", class: "fnb-word", "aria-label": options.label, title: options.title },
    options.word,
  );
  const on = () => button.getAttribute("aria-pressed") === "true";
  button.addEventListener("click", () => {
    const next = !on();
    mark(button, "aria-pressed", String(next));
    store.set(options.path, next);
  });
  return {
    el: button,
    update() {
      if (!store.pending(options.path)) mark(button, "aria-pressed", String(options.value()));
    },
  };
}

export function button(
  label: string,
  name: IconName,
  action: () => void,
  attributes: Record<string, string> = {},
): HTMLButtonElement {
  const element = h(
    "button",
    { type: "button", class: "fnb-button", "aria-label": label, title: label, ...attributes },
    icon(name),
  );
  element.addEventListener("click", action);
  return element;
}

/**
 * The faults of some fields, to stand under them. With `under`, a fault in a one-line text is shown as a caret alone, right
 * under its place in that field; else with the line that is at fault.
 */
export function faultBox(store: Store, paths: () => Path[], under?: HTMLTextAreaElement): Field {
  const el = h("div", { class: "fnb-faults", role: "alert", hidden: true });
  let shown = "[]";
  return {
    el,
    update() {
      const keys = new Set(paths().map(keyOf));
      const drafts = store.get("drafts").filter((draft) => keys.has(keyOf(draft.path)));
      const state = JSON.stringify([drafts, under?.rows]);
      if (state === shown) return;
      shown = state;
      el.hidden = drafts.length === 0;
      el.replaceChildren(...drafts.flatMap((draft) => draft.faults.map((fault) => faultLine(fault, draft, under))));
    },
  };
}

export function faultLine(fault: Fault, draft?: DraftState, under?: HTMLTextAreaElement): HTMLElement {
  const line = h("div", { class: "fnb-fault" });
  if (fault.excerpt && fault.column !== null) {
    const oneLine = under && under.rows === 1 && String(draft?.value ?? "") === fault.excerpt.split("\n")[0];
    const caret = h("pre", { class: oneLine ? "fnb-caret fnb-caret-under" : "fnb-caret" });
    setText(caret, oneLine ? (fault.excerpt.split("\n")[1] ?? "") : fault.excerpt);
    line.append(caret);
  }
  const own = draft && fault.place && draft.path.join(".").startsWith(fault.place);
  const message = h("span", { class: "fnb-fault-text" });
  setText(message, own || !fault.place ? fault.message : `${fault.place}: ${fault.message}`);
  line.append(message);
  return line;
}
