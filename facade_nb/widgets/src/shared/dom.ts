// Making elements. Text is only ever set as text.

import type { WidgetModel } from "./types.ts";

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined>;

function fill<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => !!child));
  return element;
}

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = fill(document.createElement(tag), attributes, children);
  // JupyterLab takes keys from focused buttons and fields in command mode unless the element itself says so.
  if (["input", "button", "select", "textarea", "summary"].includes(tag) || "tabindex" in attributes)
    element.setAttribute("data-lm-suppress-shortcuts", "true");
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  return fill(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

/** Set several traits of a model. */
export function setTraits(model: WidgetModel, values: Record<string, unknown>): void {
  for (const [name, value] of Object.entries(values)) model.set(name, value);
}

/** Set an attribute only where it differs: fewer style recalculations, and tests see honest mutations. */
export function mark(element: Element, name: string, value: string | boolean | null): void {
  const next = value === false || value === null ? null : value === true ? "" : value;
  if (element.getAttribute(name) === next) return;
  if (next === null) element.removeAttribute(name);
  else element.setAttribute(name, next);
}

export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** The element that has the focus, in the document or shadow tree that another one stands in. */
export function focused(among: Element): Element | null {
  return (among.getRootNode() as Partial<DocumentOrShadowRoot>).activeElement ?? null;
}

export interface Row<T> {
  el: HTMLElement;
  update(item: T): void;
}

const FOCUSABLE = "button, input, select, textarea, summary, [tabindex]";

/** What in an element can be given the focus now, in order. */
export function focusables(el: Element): HTMLElement[] {
  const all = [...el.querySelectorAll<HTMLElement>(FOCUSABLE)];
  return all.filter((one) => !one.matches(":disabled, [hidden], [hidden] *, [tabindex='-1']"));
}

/** Give the focus to where in an element the next thing is typed. */
export function focusMain(el: Element): boolean {
  const main = el.querySelector<HTMLElement>("[data-main]:not(:disabled)") ?? focusables(el)[0];
  main?.focus({ preventScroll: true });
  return main !== undefined;
}

/**
 * Keep one row per item, by key, in the items' order; rows that stay keep their element, focus and caret. Where the row that
 * has the focus goes, the focus goes to the row in its place: to the same thing in it, if it has only another name.
 */
export function keyed<T>(parent: HTMLElement, keyOf: (item: T) => string, make: (item: T) => Row<T>) {
  const rows = new Map<string, Row<T>>();
  return (items: T[]): void => {
    const before = focused(parent);
    const many = rows.size;
    const row = [...parent.children].findIndex((el) => before && el.contains(before));
    const spot = row < 0 ? -1 : focusables(parent.children[row] as Element).indexOf(before as HTMLElement);
    const keys = new Set(items.map(keyOf));
    for (const [key, row] of rows)
      if (!keys.has(key)) {
        row.el.remove();
        rows.delete(key);
      }
    let at = parent.firstElementChild;
    for (const item of items) {
      let row = rows.get(keyOf(item));
      if (!row) {
        row = make(item);
        rows.set(keyOf(item), row);
      }
      if (row.el === at) at = at.nextElementSibling;
      else parent.insertBefore(row.el, at);
      row.update(item);
    }
    if (row < 0 || !(before instanceof HTMLElement) || before === focused(parent)) return;
    const next = parent.children[Math.min(row, parent.childElementCount - 1)];
    if (parent.contains(before)) before.focus({ preventScroll: true });
    else if (next && (items.length !== many || !follow(before, focusables(next)[spot]))) focusMain(next);
  };
}

/** Go on in a field that has taken the place of another one, with the caret where it was. */
function follow(before: HTMLElement, next: HTMLElement | undefined): boolean {
  next?.focus({ preventScroll: true });
  if (before instanceof HTMLTextAreaElement && next instanceof HTMLTextAreaElement)
    next.setSelectionRange(before.selectionStart, before.selectionEnd);
  return next !== undefined;
}
