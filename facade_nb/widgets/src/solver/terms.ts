// Terms of flattened patterns and equations as the paper sets them: exponents raised, sizes between bars.

import { h } from "../shared/dom.ts";

/** A term of a flattened pattern, as facade_nb/solver/analysis/terms.py tells it. */
export interface Term {
  text: string;
  letters: string[];
}

/** `A^{2m+1}` with its exponent raised. */
export function term({ text }: Term): HTMLElement {
  const at = text.lastIndexOf("^");
  const el = h("span", { class: "fnb-term" });
  if (at < 0) el.append(text);
  else el.append(text.slice(0, at), h("sup", {}, text.slice(at + 1).replace(/^\{(.*)\}$/, "$1")));
  return el;
}

/** An equation's text, its variables in italics: `2|f| = 2k − 1.5j + 3.6`. */
export function equation(text: string): Node[] {
  return text
    .split(/(\|[^|]+\||\p{L}[\p{L}\p{M}\p{Nd}_]*)/u)
    .filter(Boolean)
    .map((piece) => (/^\|?\p{L}/u.test(piece) ? h("i", {}, piece) : document.createTextNode(piece)));
}

/** The variables that an equation's text names: counters, and sizes of symbols without their bars. */
export function variables(names: Iterable<string>): { counters: string[]; symbols: string[] } {
  const all = [...names];
  const symbols = all.flatMap((name) => [...(/\|([^|]+)\|/.exec(name)?.slice(1) ?? [])]);
  return { counters: all.filter((name) => /^[\p{L}_][\p{L}\p{M}\p{Nd}_ ]*$/u.test(name)), symbols };
}
