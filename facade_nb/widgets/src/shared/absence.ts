// What a view does while its kernel is not there: it says so, and is read only. What stands in its fields stays as it was
// typed, and can be selected and copied.

import { h, mark } from "./dom.ts";
import { icon } from "./icons.ts";
import type { Kernel } from "./kernel.ts";
import { historyKey, isHosts } from "./keys.ts";

const TEXTS = 'textarea, input:not([type]), input[type="text"], input[type="search"], input[type="number"]';
const CONTROLS = 'button, select, input, textarea, [role="slider"]';

export interface Absence {
  /** The notice, the first thing in the view. */
  el: HTMLElement;
}

interface Options {
  /** Which of the controls need a kernel; "" for none, and by default all that are not marked as `data-local`. */
  needs?: string;
  /** What can be done when the kernel has gone. */
  after?: () => string;
  /** Whether something was typed that Python has not got. */
  unsent?: () => boolean;
  /** What is seen here, such as "façade". */
  what: string;
  /** What can be done meanwhile, in a sentence. */
  goesOn?: string;
}

/** Say above a view what has become of its kernel, and hold its controls meanwhile. */
export function absence(root: HTMLElement, kernel: Kernel, signal: AbortSignal, options: Options): Absence {
  const needs = options.needs ?? ":not([data-local], [data-local] *)";
  const title = h("strong", {});
  const more = h("span", {});
  const notice = h(
    "div",
    { class: "fnb-notice fnb-absence", role: "status", hidden: true },
    icon("unplugged"),
    h("div", { class: "fnb-notice-body" }, title, more),
  );
  root.prepend(notice);

  const held = (target: EventTarget | null): Element | null => {
    const control = target instanceof Element ? target.closest(CONTROLS) : null;
    return control && needs && control.matches(needs) ? control : null;
  };
  const update = () => {
    const off = kernel.presence === "away" || kernel.presence === "gone";
    notice.hidden = !off;
    mark(root, "data-kernel", off ? kernel.presence : null);
    if (off) [title.textContent, more.textContent] = sentences(kernel, options);
    for (const control of root.querySelectorAll<HTMLElement>(CONTROLS))
      if (off && needs && control.matches(needs)) hold(control);
      else if (control.dataset.held) release(control);
  };
  const keep = (event: Event) => {
    if (kernel.live || kernel.presence === "saved") return;
    const control = held(event.target);
    if (!control) return;
    // A text can be walked through and copied, and the host has its keys; but nothing of ours must read the others.
    const text = control.matches(TEXTS);
    const key = event instanceof KeyboardEvent ? event : null;
    if (key ? isHosts(key) : text && event instanceof MouseEvent) return;
    event.stopPropagation();
    if (event.type === "change") control.setAttribute("data-changed", "");
    // The browser's own undo would move the caret, in a field that it may not write to.
    const undoes = !!key && historyKey(key) !== null;
    if (undoes || (!text && key?.key !== "Tab")) event.preventDefault();
  };
  for (const name of ["keydown", "pointerdown", "mousedown", "click", "input", "change", "drop"])
    root.addEventListener(name, keep, { capture: true, signal, passive: false });
  kernel.watch(update, signal);
  update();
  return { el: notice };
}

function hold(control: HTMLElement): void {
  if (control.dataset.held) return;
  const text = control.matches(TEXTS);
  if (control.hasAttribute(text ? "readonly" : "aria-disabled")) return;
  control.dataset.held = "true";
  mark(control, text ? "readonly" : "aria-disabled", text ? true : "true");
}

function release(control: HTMLElement): void {
  delete control.dataset.held;
  const text = control.matches(TEXTS);
  mark(control, text ? "readonly" : "aria-disabled", null);
  // A field that commits when it is left could not do so meanwhile.
  if (text && !control.matches(":focus")) control.dispatchEvent(new FocusEvent("blur"));
  if (control.dataset.changed !== undefined) control.dispatchEvent(new Event("change", { bubbles: true }));
  delete control.dataset.changed;
}

function sentences(kernel: Kernel, { unsent, what, goesOn, after }: Options): [title: string, more: string] {
  const typed = unsent?.() ? " What was typed last has not reached it, and still stands in its field." : "";
  const on = goesOn ? ` ${goesOn}` : "";
  if (kernel.presence === "away")
    return [
      "No connection to the kernel.",
      `The ${what} stays as it is, read only, until the connection is back.${on}${typed}`,
    ];
  return [
    `The kernel ${kernel.fate}.`,
    `This is the ${what} as it was last, read only.${on}${typed} ${after?.() ?? "Run the cell again to go on."}`,
  ];
}
