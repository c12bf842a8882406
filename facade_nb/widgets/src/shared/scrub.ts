// A number changed by dragging on it: to the right it grows. A press without a drag puts the caret, as ever.

import { mark } from "./dom.ts";
import { type Range, stepped } from "./stepping.ts";

const SLACK = 4; // pixels that a hand moves while it clicks
const FINE = 2; // pixels for a tenth of a step
const WHOLE = 8; // pixels for a step, where only whole numbers are meant

/** The number so many pixels further on. */
export function scrubbed(value: number, pixels: number, range: Range): number {
  const steps = Math.trunc(pixels / (range.whole ? WHOLE : FINE));
  if (steps === 0) return value;
  const step = range.whole ? range.step : range.step / 10;
  return stepped(value, steps, { ...range, step });
}

/** Have a number follow a drag on its field; it is told as if it had been typed. Empty, it begins with `start`. */
export function scrub(input: HTMLInputElement, range: Range, start: () => number): void {
  input.addEventListener("pointerdown", (down) => {
    if (down.button !== 0 || input.readOnly || input.disabled || input.ownerDocument.activeElement === input) return;
    const typed = Number(input.value.replace(",", "."));
    const from = input.value.trim() === "" || !Number.isFinite(typed) ? start() : typed;
    let dragging = false;
    const move = (event: PointerEvent) => {
      const pixels = event.clientX - down.clientX;
      if (!dragging) {
        if (Math.abs(pixels) < SLACK) return;
        dragging = true;
        input.setPointerCapture?.(down.pointerId);
        mark(input, "data-scrubbed", true);
      }
      event.preventDefault();
      const next = String(scrubbed(from, pixels, range));
      input.setSelectionRange(0, 0); // no text is marked on the way
      if (next === input.value) return;
      input.value = next;
      for (const name of ["input", "change"]) input.dispatchEvent(new Event(name, { bubbles: true }));
    };
    const end = () => {
      document.removeEventListener("pointermove", move);
      mark(input, "data-scrubbed", false);
    };
    document.addEventListener("pointermove", move);
    for (const name of ["pointerup", "pointercancel"]) document.addEventListener(name, end, { once: true });
  });
}
