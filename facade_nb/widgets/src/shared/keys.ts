// Whose a key is: the field's, the widget's, the input method's, or the host's (JupyterLab, Notebook, …).
//
// A host listens at the document. JupyterLab does so while keys bubble, Notebook 7 while they are captured, and both cancel
// line breaks and undo in whatever lies within a cell. So a part says it in three ways: an attribute that both heed, set
// before they look; no `beforeinput`, by which they cancel; and no bubbling, for hosts that know nothing of the attribute.

import { mark } from "./dom.ts";
import { composed, insert } from "./writing.ts";

const KEPT = "data-lm-suppress-shortcuts";
const MAC = /Mac|iPhone|iPad/;

/** The letter of a key: what it types where that is of our alphabet or a sign, else what stands at its place. */
export function letterOf({ key, code }: KeyboardEvent): string {
  const typed = [...key].length === 1;
  if (typed && /^[\p{Script=Latin}\p{ASCII}]$/u.test(key)) return key.toLowerCase();
  return /^Key([A-Z])$/.exec(code)?.[1]?.toLowerCase() ?? (typed ? key : "");
}

/** Whether a key asks to undo or to redo. */
export function historyKey(event: KeyboardEvent): "undo" | "redo" | null {
  if (!(event.ctrlKey || event.metaKey) || event.altKey) return null;
  const letter = letterOf(event);
  if (letter === "z") return event.shiftKey ? "redo" : "undo";
  return letter === "y" && !event.shiftKey ? "redo" : null;
}

/** Whether a key is the input method's: it composes a letter, or ends to. */
export function ofInputMethod(event: KeyboardEvent): boolean {
  return event.isComposing || event.keyCode === 229;
}

/**
 * Whether a key is the host's: Ctrl+S, Ctrl+B, F1, Alt+1, Esc. What types, moves the caret, deletes, selects, copies or
 * undoes is not, nor is Enter with whatever is held: it must not run the cell, which would make the widget anew.
 */
export function isHosts(event: KeyboardEvent): boolean {
  if (event.key === "Escape" || /^F\d+$/.test(event.key)) return true;
  const chord = event.ctrlKey || event.metaKey;
  const letter = letterOf(event);
  if (letter === "" || letter === " " || event.getModifierState("AltGraph")) return false;
  if (!chord) return event.altKey && !MAC.test(navigator.platform); // there, Alt types
  if (event.altKey) return true;
  return !(event.shiftKey ? "vz" : "acvxyz").includes(letter);
}

/** Whether an element is a field that text is typed into. */
export function takesText(element: unknown): element is HTMLInputElement | HTMLTextAreaElement {
  if (element instanceof HTMLTextAreaElement) return true;
  return element instanceof HTMLInputElement && ["text", "search", "number"].includes(element.type);
}

/**
 * Give a part its keys, and its host the rest; tell fields of a composition when it has ended. With `history`, undo and redo
 * go there from wherever in the part they are pressed.
 */
export function keepKeys(root: HTMLElement, signal: AbortSignal, history?: (op: "undo" | "redo") => void): void {
  window.addEventListener("keydown", (event) => label(root, event), { capture: true, signal });
  const early = { capture: true, signal };
  root.addEventListener("keydown", (event) => ofInputMethod(event) && event.stopPropagation(), early);
  root.addEventListener("beforeinput", (event) => event.stopPropagation(), early);
  root.addEventListener("input", (event) => (event as InputEvent).isComposing && event.stopPropagation(), early);
  root.addEventListener("compositionstart", ({ target }) => target && composed.add(target), early);
  root.addEventListener(
    "compositionend",
    ({ target }) => {
      if (!target) return;
      composed.delete(target);
      target.dispatchEvent(new InputEvent("input", { bubbles: true }));
    },
    early,
  );
  root.addEventListener(
    "keydown",
    (event) => {
      const op = historyKey(event);
      if (op && history && !event.defaultPrevented) {
        // The field's own undo would know only this field; the history knows all of them.
        event.preventDefault();
        history(op);
      }
      // By itself, a browser types a line with Ctrl in some systems only.
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey) && event.target instanceof HTMLTextAreaElement) {
        event.preventDefault();
        if (!event.target.readOnly) insert(event.target, "\n");
      }
      // Then the host has the focus again: in a notebook, the cell.
      if (event.key === "Escape" && takesText(event.target)) event.target.blur();
      if (!isHosts(event)) event.stopPropagation();
    },
    { signal },
  );
}

/** What Python puts around a part, with fields that are not ours, has this class. */
const AROUND = ".facade-nb-keys";

/** Keep the keys of what stands around a part as well, once the part stands in it: else its lists' letters are the host's. */
export function keepKeysAround(el: HTMLElement, signal: AbortSignal): void {
  const observer = new ResizeObserver(() => {
    const around = el.closest<HTMLElement>(AROUND);
    if (!around) return;
    observer.disconnect();
    const ours = ({ target }: Event) => target instanceof Element && target.closest(".fnb") !== null; // it keeps them itself
    window.addEventListener("keydown", (event) => ours(event) || label(around, event), { capture: true, signal });
    around.addEventListener("keydown", (event) => isHosts(event) || event.stopPropagation(), { signal });
  });
  observer.observe(el);
  signal.addEventListener("abort", () => observer.disconnect());
}

/** Say to the host, before it looks, whose key this is. */
function label(root: HTMLElement, event: KeyboardEvent): void {
  const path = event.composedPath();
  const end = path.indexOf(root);
  if (end < 0) return;
  const within = path.slice(0, end + 1).filter((each) => each instanceof Element);
  if (ofInputMethod(event) || !isHosts(event)) mark(within[0] as Element, KEPT, "true");
  else for (const element of within) mark(element, KEPT, null);
}
