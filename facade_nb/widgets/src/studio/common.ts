// What the editors share: the shape of a part, sections, rows that answer to the selection.

import { focusMain, h, mark } from "../shared/dom.ts";
import { button, type Field, nameField } from "../shared/fields.ts";
import { colourAt, slotsOf } from "../shared/palette.ts";
import type { Store } from "../shared/store.ts";
import type { Resolve } from "./links.ts";
import { placesOf } from "./places.ts";

export interface Context {
  store: Store;
  signal: AbortSignal;
  /** Tell the person something that asks for no answer. */
  notify(text: string): void;
}

/** A part makes its element and keeps it up to date until the signal ends. */
export type MakePart = (context: Context) => HTMLElement;

/** A titled list that can be folded, with a button that adds to it. */
export function section(
  title: string,
  body: HTMLElement,
  options: { add?: { label: string; action: () => void }; open?: boolean } = {},
): HTMLElement {
  const summary = h("summary", { class: "fnb-title" }, h("span", {}, title));
  const count = h("span", { class: "fnb-count" });
  summary.append(count);
  const details = h("details", { class: "fnb-section", open: options.open ?? true }, summary, body);
  if (!options.add) return details;
  const add = button(options.add.label, "plus", options.add.action, { class: "fnb-button fnb-add" });
  return h("div", { class: "fnb-section-box" }, details, add);
}

/** Mark a row as picked, and bring it into view in its own list when it has just become so. */
export function markPicked(row: HTMLElement, picked: boolean): void {
  const before = row.hasAttribute("data-picked");
  mark(row, "data-picked", picked);
  if (picked && !before) scrollWithin(row);
}

/** Scroll the row's list, where it is one that scrolls: a click on the façade must move neither the panel nor the page. */
function scrollWithin(row: HTMLElement): void {
  const list = row.closest<HTMLElement>(".fnb-list");
  if (list) bring(row, list);
}

/** Scroll what holds a row by as little as shows the row. */
function bring(row: HTMLElement, holder: HTMLElement): void {
  const [outer, inner] = [holder.getBoundingClientRect(), row.getBoundingClientRect()];
  if (inner.top < outer.top) holder.scrollTop -= outer.top - inner.top;
  else if (inner.bottom > outer.bottom) holder.scrollTop += inner.bottom - outer.bottom;
}

export function emptyNote(text: string): HTMLElement {
  return h("p", { class: "fnb-empty" }, text);
}

/** A colour for each symbol, the same in every part and for as long as it is there. */
export function tint(store: Store, symbol: string): string {
  const names = store.get("design").symbols.map((other) => other.name);
  const slot = slotsOf(store.prefix, names).get(symbol);
  return slot === undefined ? "var(--fnb-muted)" : colourAt(slot);
}

/** Names of the materials there are: those of the catalogue, and the rules of the design's grammar. */
export function materialsOf(store: Store): string[] {
  return [...store.get("catalogue").materials, ...Object.keys(store.get("design").rules ?? {})];
}

/** The colours that stand for materials. */
export function swatchesOf(store: Store): Record<string, string> {
  const rules = Object.entries(store.get("design").rules ?? {}).filter(([, colour]) => colour);
  return { ...store.get("catalogue").swatches, ...Object.fromEntries(rules) };
}

/** What hover links ask of the design of a store. */
export function resolveIn(store: Store): Resolve {
  return {
    places: (cell) => placesOf(store, cell),
    patterns(name) {
      const layer = store.get("design").layers.find((other) => other.name === name);
      return layer ? [layer.x.pattern, layer.y.pattern] : [];
    },
  };
}

/** A colour for each alignment group but the default one. */
export function groupTint(store: Store, group: string): string {
  const groups = store.get("design").groups.filter((other) => other !== "default");
  const at = groups.indexOf(group);
  return at < 0 ? "var(--fnb-line-strong)" : hue(at + 2);
}

/** By the golden angle, any number of hues are far apart from those before. */
function hue(at: number): string {
  return `hsl(${Math.round((at * 137.508 + 210) % 360)} 62% 52%)`;
}

/** A button whose name is edited in place: by a double click, or by F2. Enter takes it over, Escape gives it back. */
export function renamed(
  shown: HTMLButtonElement,
  options: { label: string; value: () => string; commit: (name: string) => void },
): Field {
  const name = nameField({ ...options, next: () => shown });
  const input = name.el as HTMLInputElement;
  input.hidden = true;
  const begin = () => {
    shown.hidden = true;
    input.hidden = false;
    name.update();
    input.focus();
    input.select();
  };
  const end = () => {
    input.hidden = true;
    shown.hidden = false;
  };
  // Before its own listeners: a hidden button cannot take the focus.
  input.addEventListener(
    "keydown",
    (event) => {
      if (event.key === "Enter") shown.hidden = false;
      if (event.key !== "Escape") return;
      event.preventDefault();
      event.stopPropagation();
      input.value = options.value();
      end();
      shown.focus();
    },
    { capture: true },
  );
  input.addEventListener("blur", end);
  shown.addEventListener("dblclick", begin);
  shown.addEventListener("keydown", (event) => {
    if (event.key !== "F2") return;
    event.preventDefault();
    begin();
  });
  return { el: h("span", { class: "fnb-renamed" }, shown, input), update: name.update };
}

/** When what this view has asked for is added, the focus goes there, as soon as it is shown. */
export function focusAdded(store: Store, what: string, list: HTMLElement): () => void {
  let name = "";
  const look = () => {
    const row = [...list.children].find((el) => name !== "" && el.getAttribute(`data-${what}`) === name);
    if (!row) return;
    name = "";
    focusMain(row);
    scrollWithin(row as HTMLElement);
    // Where the next thing is typed must be seen.
    const panel = row.closest<HTMLElement>(".fnb-panel");
    if (panel) bring(row as HTMLElement, panel);
  };
  store.onReply((reply) => {
    if (reply.kind !== "added" || reply.what !== what) return;
    name = reply.name;
    look();
  });
  return look;
}
