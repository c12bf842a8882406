// Writing into a field that somebody may be typing in.

import { focused } from "./dom.ts";

type Area = HTMLInputElement | HTMLTextAreaElement;

/** Fields that an input method is at work in: their text is half a text, and must be let alone. */
export const composed = new WeakSet<EventTarget>();

/** Where two texts differ: how much is the same before, and how long the differing piece is in each. */
export function difference(old: string, now: string): { from: number; gone: number; come: number } {
  const least = Math.min(old.length, now.length);
  let from = 0;
  while (from < least && old[from] === now[from]) from += 1;
  let same = 0;
  while (same < least - from && old.at(-1 - same) === now.at(-1 - same)) same += 1;
  return { from, gone: old.length - from - same, come: now.length - from - same };
}

/**
 * Give a field another text. The caret stays at the letters it was at; with `follow` it goes to where the text has changed,
 * as undo does. A text that is being composed is let alone.
 */
export function write(field: Area, text: string, follow = false): void {
  const now = text.replace(/\r\n?/g, "\n"); // as the field itself has it
  if (field.value === now || composed.has(field)) return;
  const { from, gone, come } = difference(field.value, now);
  const moved = (at: number) => (at <= from ? at : at >= from + gone ? at + come - gone : from + come);
  const [start, end] = [field.selectionStart ?? 0, field.selectionEnd ?? 0];
  const [left, top] = [field.scrollLeft, field.scrollTop];
  field.value = now;
  const caret = from + come;
  if (follow) field.setSelectionRange(caret, caret);
  else if (focused(field) === field) field.setSelectionRange(moved(start), moved(end)); // elsewhere it might take the focus
  field.scrollTo?.(left, top);
  if (follow) reveal(field);
}

/** Type something where the caret is. */
export function insert(field: Area, text: string): void {
  field.setRangeText(text, field.selectionStart ?? 0, field.selectionEnd ?? 0, "end");
  field.dispatchEvent(new InputEvent("input", { bubbles: true }));
  reveal(field);
}

/** Scroll until the caret's line is seen, in a field that wraps none. */
function reveal(area: Area): void {
  if (!(area instanceof HTMLTextAreaElement)) return;
  const line = area.value.slice(0, area.selectionEnd).split("\n").length - 1;
  const height = Number.parseFloat(getComputedStyle(area).lineHeight);
  if (!Number.isFinite(height) || area.wrap !== "off") return;
  const [above, below] = [line * height, (line + 3) * height - area.clientHeight];
  if (area.scrollTop > above) area.scrollTop = above;
  else if (area.scrollTop < below) area.scrollTop = below;
}
