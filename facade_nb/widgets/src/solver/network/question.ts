// “Which edge is next?”: what can be chosen, what is right, and why.

import { h } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import type { Quiz } from "../quiz.ts";
import { EPS } from "../weights.ts";
import { columnText } from "./lists.ts";
import { type Arc, type Base, edgeKey, leaving, stepArc } from "./scene.ts";
import { type Story, type Subject, TAKEN } from "./story.ts";

const CHOICES = 8;

export interface Choice {
  arc: Arc;
  right: boolean;
  why: string;
}

export const keyOf = ({ arc }: Choice): string => `${arc.key}>${arc.to.join(",")}`;

/** What a choice is called, in the list and in the drawing. */
export const nameOf = (n: number): string => String.fromCharCode(97 + n);

/** What can be chosen: edges that wait for their turn; once the search is over, those that leave the path's first fork. */
export function choicesOf(story: Story, subject: Subject, base: () => Base, position: number): Choice[] {
  const { data } = story;
  const next = story.next(subject, position, TAKEN);
  const path = next === undefined ? -1 : (data.steps.path[next] ?? -1);
  if (next !== undefined && path >= 0) {
    const [until, least] = [data.steps.at[next] ?? 0, data.steps.bound[next] ?? 0];
    const told = story.told(subject, until - 1);
    const gone = new Set(Array.from(told.taken, (step) => data.steps.path[step]));
    const open = Array.from(told.weighed).filter(
      (step) => !gone.has(data.steps.path[step] ?? -1) && story.reasonOf(step) !== "dropped",
    );
    const choices = open
      .sort((x, y) => (data.steps.bound[x] ?? 0) - (data.steps.bound[y] ?? 0) || x - y)
      .slice(0, CHOICES)
      .sort((x, y) => x - y)
      .map((step): Choice => {
        const bound = data.steps.bound[step] ?? 0;
        const right = bound <= least + EPS;
        const why = right
          ? `No alignment that goes on so costs less than J = ${formatNumber(bound)} m: the least of all.`
          : `J ≥ ${formatNumber(bound)} m this way; another edge promises ${formatNumber(least)} m.`;
        return { arc: { ...stepArc(story, subject, step, "weighed"), kind: "choice", text: "" }, right, why };
      });
    const different = distinct(choices);
    if (different.some(({ right }) => right) && different.length > 1) return different;
  }
  const network = base();
  const columns = subject.path?.columns ?? [];
  let from = subject.bands.map(() => 0);
  for (const column of columns) {
    const arcs = leaving(story, subject, network, story.told(subject, 1e9), from).filter((arc) => !arc.constraint);
    const key = edgeKey(subject, from, column.letters);
    const own = arcs.find((arc) => arc.key === key && arc.to.join() === column.after.join());
    if (own && arcs.length > 1) {
      const others = arcs.filter((arc) => arc !== own).slice(0, CHOICES - 1);
      const ways = [own, ...others]
        .sort((x, y) => x.to.join().localeCompare(y.to.join(), "en", { numeric: true }))
        .map((arc) => ({
          arc,
          right: arc === own,
          why:
            arc === own
              ? `The path goes here: ω = ${formatNumber(arc.omega)} m, Ω = ${formatNumber(subject.path?.error)} m in all.`
              : arc.text || `ω = ${formatNumber(arc.omega)} m here; but no alignment that goes on so is better in all.`,
        }));
      const different = distinct(ways);
      if (different.length > 1) return different;
    }
    from = column.after;
  }
  return [];
}

/** An edge may wait behind several paths; it is one choice, and right if it is right for one of them. */
function distinct(choices: readonly Choice[]): Choice[] {
  const found = new Map<string, Choice>();
  for (const own of choices) if (own.right || !found.has(keyOf(own))) found.set(keyOf(own), own);
  return [...found.values()];
}

/** The choices with their radio buttons and, once it is checked, the reason of each. */
export function question(subject: Subject, choices: readonly Choice[], searching: boolean, quiz: Quiz): HTMLElement {
  if (!choices.length)
    return h("p", { class: "fnb-muted" }, "There is only one way on from here: step back, or choose another network.");
  const list = choices.map((own, n) => {
    const key = keyOf(own);
    const { state, why } = quiz.verdict(key);
    const radio = h("input", {
      type: "radio",
      name: "fnb-net-choice",
      "aria-label": `edge ${nameOf(n)}`,
    });
    radio.checked = quiz.has(key);
    radio.disabled = quiz.done;
    radio.addEventListener("change", () => quiz.choose(key));
    return h(
      "li",
      { class: "fnb-net-edge", "data-verdict": state, "data-choice": nameOf(n) },
      h("label", {}, radio, h("b", {}, nameOf(n)), columnText(subject, own.arc.column, own.arc.to)),
      h("span", { class: "fnb-net-omega" }, own.arc.omega === null ? "" : `ω ${formatNumber(own.arc.omega, 2)}`),
      h("span", { class: "fnb-net-why" }, why),
    );
  });
  const text = searching
    ? "These edges wait for their turn. The search takes up the one by which an alignment can be cheapest."
    : "Which of these does the shortest path take?";
  return h("div", { class: "fnb-net-leaving" }, h("p", { class: "fnb-muted" }, text), h("ul", {}, ...list));
}
