// Words that agree on their counters, side by side: the candidates of the paper's Figure 7.

import { h } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import type { Candidate } from "../bounds.ts";
import { spelled } from "../letters.ts";
import { linked, target } from "../links.ts";
import type { Axis } from "../timeline.ts";
import { subscript } from "./sentences.ts";

/** “Candidates for alignment”: one column each, as in the paper's figure. */
export function tupleTable(patterns: string[], tuples: Candidate[][], more: boolean, axis: Axis): HTMLElement {
  const counters = [...new Set(tuples.flatMap((tuple) => tuple.flatMap((word) => Object.keys(word.event.counters))))];
  const sampled = [...new Set(tuples.flatMap((tuple) => tuple.flatMap((word) => Object.keys(word.sizes))))];
  const value = (tuple: Candidate[], name: string) =>
    formatNumber(tuple.find((word) => name in word.event.counters)?.event.counters[name]);
  const size = (tuple: Candidate[], name: string) =>
    formatNumber(tuple.find((word) => name in word.sizes)?.sizes[name]);
  const body: HTMLElement[] = [];
  if (counters.length)
    body.push(
      h(
        "tr",
        {},
        h("th", {}, counters.length > 1 ? `(${counters.join(", ")})` : (counters[0] ?? "")),
        ...tuples.map((tuple) => {
          const values = counters.map((name) => value(tuple, name));
          return h("td", {}, values.length > 1 ? `(${values.join(", ")})` : values.join());
        }),
      ),
    );
  for (const name of sampled)
    body.push(h("tr", {}, h("th", {}, `|${name}|`), ...tuples.map((tuple) => h("td", {}, size(tuple, name)))));
  for (const [n, pattern] of patterns.entries())
    body.push(
      h(
        "tr",
        {},
        h("th", { title: pattern }, "w", subscript(n + 1)),
        ...tuples.map((tuple) => {
          const word = tuple[n] as Candidate;
          const cell = h("td", linked([target.word(axis, pattern, word.event.word)]));
          cell.append(...spelled(word.event.letters));
          return cell;
        }),
      ),
    );
  const count = more ? `the first ${tuples.length}` : String(tuples.length);
  return h(
    "div",
    { class: "fnb-tuple-box" },
    h("h4", {}, `Candidates for alignment (${count})`),
    tuples.length
      ? h("div", { class: "fnb-tuple-scroll" }, h("table", {}, h("tbody", {}, ...body)))
      : h("p", { class: "fnb-empty" }, "No words agree on their counters."),
  );
}
