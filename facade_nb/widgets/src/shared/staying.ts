// The focus stays in a part when what has it goes: it would fall to the host, where two presses of `d` delete a cell.

import { focusables, focused, focusMain } from "./dom.ts";

const hidden = (el: Element) => el.matches(":disabled, [hidden], [hidden] *");

/** Whenever the element that has the focus is removed, disabled or hidden, give the focus to what is nearest to it. */
export function keepFocus(root: HTMLElement, signal: AbortSignal): void {
  root.tabIndex = -1; // a press beside all fields is the part's, too
  let held: Element | null = null;
  let within: Element[] = [];
  const lost = () => held !== null && (!root.contains(held) || hidden(held));
  root.addEventListener(
    "focusin",
    ({ target }) => {
      held = target as Element;
      within = [];
      for (let el = held.parentElement; el && el !== root; el = el.parentElement) within.push(el);
    },
    { signal },
  );
  root.addEventListener(
    "focusout",
    ({ target }) => {
      // Told before an element is removed, too: whether it was left is seen only afterwards.
      queueMicrotask(() => {
        if (held === target && !lost() && focused(root) !== held) held = null;
      });
    },
    { signal },
  );
  const look = () => {
    if (!lost()) return;
    const now = focused(root);
    const elsewhere = now !== null && now !== held && now !== document.body && !now.contains(root);
    if (!elsewhere) {
      const near = within.find((el) => root.contains(el) && !hidden(el) && focusables(el).length > 0);
      held = null;
      if (!near || !focusMain(near)) root.focus({ preventScroll: true });
    } else held = null;
  };
  const observer = new MutationObserver(look);
  observer.observe(root, { subtree: true, childList: true, attributeFilter: ["disabled", "hidden"] });
  signal.addEventListener("abort", () => observer.disconnect());
}
