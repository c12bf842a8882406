// What is said of a word: whether it fits, and why not.

import { h } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import type { Candidate, Judged } from "../bounds.ts";

export const keyOf = (pattern: string, word: Candidate): string =>
  [pattern, word.event.at, ...Object.values(word.sizes)].join("|");

export const free = (word: Candidate): boolean =>
  word.event.letters.some((a) => a.size === null && !(a.symbol in word.sizes));

/** @param bare without a sign: before it stands whether the reader was right */
export function reasonText(word: Candidate, taken: boolean, bare: boolean): string {
  if (taken && word.reason === "fits") return bare ? "fits, taken" : "✓ fits, taken";
  const by = word.missed ? ` by ${formatNumber(word.missed, 2)}` : "";
  const signed = word.reason === "fits" ? "✓ " : word.reason === "no partner" ? "– " : "✕ ";
  return `${bare ? "" : signed}${word.reason}${by}`;
}

export function sentence(word: Candidate, own: Judged): string {
  const size = formatNumber(word.size, 2);
  switch (word.reason) {
    case "too long":
      return `${size} m is longer than canvas + μ = ${formatNumber(own.high, 2)} m.`;
    case "too short":
      return `${size} m is shorter than ${formatNumber(own.low, 2)} m, which is all that can be left open.`;
    case "no partner":
      return "It fits, but another pattern has no word with these values of the counters.";
    case "left out":
      return "The pattern has more words than can be looked at.";
    default:
      return free(word) ? `${size} m is sized; unsized letters take what is left.` : `${size} m is within the bounds.`;
  }
}

export function boundsText(own: Judged, canvas: number): string {
  const push = own.push ? `, less ${formatNumber(own.push, 2)} m that opaque letters above may push aside` : "";
  return `Eq. 7: the canvas of ${formatNumber(canvas)} m, ± μ = ${formatNumber(own.high - canvas, 3)} m${push}.`;
}

export function subscript(number: number): HTMLElement {
  return h("sub", {}, String(number));
}
