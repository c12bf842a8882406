// What the editors share: the shape of a part, sections, rows that answer to the selection.

import { h, mark } from "../shared/dom.ts";
import { button } from "../shared/fields.ts";
import type { Store } from "../shared/store.ts";

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

/** Mark a row as picked, and bring it into view when it has just become so. */
export function markPicked(row: HTMLElement, picked: boolean): void {
  const before = row.hasAttribute("data-picked");
  mark(row, "data-picked", picked);
  if (picked && !before) scrollWithin(row);
}

/** Scroll the panel, never the page: a click on the façade must not move the notebook. */
function scrollWithin(row: HTMLElement): void {
  const panel = row.closest<HTMLElement>(".fnb-panel");
  if (!panel) return;
  const [outer, inner] = [panel.getBoundingClientRect(), row.getBoundingClientRect()];
  if (inner.top < outer.top) panel.scrollTop -= outer.top - inner.top + 8;
  else if (inner.bottom > outer.bottom) panel.scrollTop += inner.bottom - outer.bottom + 8;
}

export function emptyNote(text: string): HTMLElement {
  return h("p", { class: "fnb-empty" }, text);
}
