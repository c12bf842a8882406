// “Which edge is next?”: what can be chosen, what is right, and why.

import { h } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { type Quiz, sign } from "../../shared/quiz.ts";
import { ledgerOfPath } from "../align/question.ts";
import type { Lattice } from "../lattice.ts";
import { EPS } from "../weights.ts";
import { columnText } from "./lists.ts";
import { edgesAt, laidBy, metres } from "./numbers.ts";
import { type Arc, type Base, edgeKey, stepArc } from "./scene.ts";
import { type Story, type Subject, TAKEN } from "./story.ts";

const CHOICES = 8;
/** Sums that are nearer than that look alike, as they are rounded. */
const CLOSE = 0.002;

/** An edge with what is laid by it, and what is still to come at least, metres. */
interface Way {
  arc: Arc;
  g: number;
  h: number;
}

export interface Choice extends Way {
  right: boolean;
  why: string;
}

export const keyOf = ({ arc }: Pick<Choice, "arc">): string => `${arc.key}>${arc.to.join(",")}`;

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
      .filter((step) => {
        const over = (data.steps.bound[step] ?? 0) - least;
        return over <= EPS || over > CLOSE;
      })
      .slice(0, CHOICES)
      .sort((x, y) => x - y)
      .map((step): Choice => {
        const bound = data.steps.bound[step] ?? 0;
        const g = laidBy(story, subject, step);
        const right = bound <= least + EPS;
        const why = right
          ? `No alignment that goes on so costs less than J = ${formatNumber(bound)} m: the least of all.`
          : `J ≥ ${formatNumber(bound)} m this way; another edge promises ${formatNumber(least)} m.`;
        return {
          arc: { ...stepArc(story, subject, step, "weighed"), kind: "choice", text: "" },
          g,
          h: Math.max(0, bound - g),
          right,
          why,
        };
      });
    const different = distinct(choices);
    if (different.some(({ right }) => right) && different.length > 1) return different;
  }
  return forksOf(story, subject, base());
}

const forks = new WeakMap<Base, { subject: Subject; choices: Choice[] }>();

/** The edges at the path's first fork where it is known of the others that every alignment through them costs more. */
function forksOf(story: Story, subject: Subject, base: Base): Choice[] {
  const known = forks.get(base); // they are asked for at every verdict, and looked for in the whole lattice
  if (known?.subject === subject) return known.choices;
  const choices = forksFound(story, subject, base);
  forks.set(base, { subject, choices });
  return choices;
}

function forksFound(story: Story, subject: Subject, base: Base): Choice[] {
  const { path } = subject;
  if (!path) return [];
  const whole = ledgerOfPath(path, base.group).cost;
  const ways = base.lattice ? waysInLattice(subject, base, base.lattice) : waysTold(story, subject);
  let from = subject.bands.map(() => 0);
  for (const [n, column] of path.columns.entries()) {
    const key = `${edgeKey(subject, from, column.letters)}>${column.after.join()}`;
    const here = ways(n, from);
    const own = here.find((way) => keyOf(way) === key);
    const others = here.filter((way) => keyOf(way) !== key && way.g + way.h > whole + CLOSE);
    if (own && others.length) {
      const shown = [own, ...others.sort((x, y) => x.g + x.h - (y.g + y.h)).slice(0, CHOICES - 1)];
      return shown
        .sort((x, y) => x.arc.to.join().localeCompare(y.arc.to.join(), "en", { numeric: true }))
        .map((way): Choice => ({ ...way, right: way === own, why: reason(way, way === own, path.error, whole) }));
    }
    from = column.after;
  }
  return [];
}

function reason({ arc, g, h }: Way, isRight: boolean, error: number, whole: number): string {
  if (isRight)
    return `The path goes here: ω = ${formatNumber(arc.omega)} m, Ω = ${formatNumber(error)} m in all, J = ${formatNumber(whole)} m.`;
  return `ω = ${formatNumber(arc.omega)} m here; but J ≥ ${formatNumber(g + h)} m this way, and the path has ${formatNumber(whole)} m.`;
}

/** Edges that go on from a node of the path, by the number of the column that leaves it. */
type Ways = (column: number, from: readonly number[]) => Way[];

/** In a lattice that is known as a whole: h is the cheapest way to the end. */
function waysInLattice(subject: Subject, base: Base, { nodes, edges }: Lattice): Ways {
  const last = subject.bands.map(({ letters }) => 2 * letters.length);
  const rest = nodes.map(({ places }) => (places.join() === last.join() ? 0 : Number.POSITIVE_INFINITY));
  for (const { source, target, cost, refusal } of edges.toReversed())
    if (!refusal) rest[source] = Math.min(rest[source] ?? Infinity, cost + (rest[target] ?? Infinity));
  // Of edges that look alike the one that the path takes, else the cheapest.
  let [at, laid] = [0, 0];
  const before: { at: number; laid: number }[] = [];
  for (const column of subject.path?.columns ?? []) {
    before.push({ at, laid });
    const step = edges
      .filter((own) => own.source === at && !own.refusal && nodes[own.target]?.places.join() === column.after.join())
      .filter(
        ({ column: options }) =>
          JSON.stringify(options.map(({ letters }) => letters)) === JSON.stringify(column.letters),
      )
      .sort((x, y) => x.cost + (rest[x.target] ?? Infinity) - (y.cost + (rest[y.target] ?? Infinity)))[0];
    if (!step) break;
    [at, laid] = [step.target, laid + step.cost];
  }
  const arcs = new Map(base.arcs.map((arc) => [`${arc.key}>${arc.to.join()}`, arc]));
  return (n, from) => {
    const here = before[n];
    if (!here) return [];
    const found = new Map<string, Way>();
    for (const { source, target, column, cost, refusal } of edges) {
      const h = rest[target] ?? Number.POSITIVE_INFINITY;
      if (source !== here.at || refusal || h === Number.POSITIVE_INFINITY) continue;
      const letters = column.map((option) => option.letters);
      const key = `${edgeKey(subject, from, letters)}>${nodes[target]?.places.join()}`;
      const arc = arcs.get(key);
      const known = found.get(key);
      if (arc && (!known || here.laid + cost + h < known.g + known.h)) found.set(key, { arc, g: here.laid + cost, h });
    }
    return [...found.values()];
  };
}

/** What the search itself has told of the edges at a node. */
function waysTold(story: Story, subject: Subject): Ways {
  const told = story.told(subject, 1e9);
  return (_, from) => {
    const nameOf = (column: (number[] | null)[], to: readonly (number | null)[]) =>
      `${edgeKey(subject, from, column)}>${to.map((place, b) => place ?? from[b] ?? 0).join()}`;
    const numbers = edgesAt(story, subject, told, from, 1e9, nameOf);
    const arcs = [...told.weighed]
      .filter((step) => story.isAt(step, from))
      .map((step) => stepArc(story, subject, step, "weighed"));
    return [...new Map(arcs.map((arc) => [`${arc.key}>${arc.to.join()}`, arc]))].flatMap(([key, arc]): Way[] => {
      const own = numbers.get(key);
      return own && own.f !== null ? [{ arc, g: own.g, h: Math.max(0, own.f - own.g) }] : [];
    });
  };
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
    return h("p", { class: "fnb-muted" }, "Nothing is to be chosen here: step back, or choose another network.");
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
      h(
        "span",
        { class: "fnb-net-numbers", title: "Laid with it, and still to come at least, metres" },
        `g ${metres(own.g)}, h ${metres(own.h)}`,
      ),
      h("span", { class: "fnb-net-why" }, sign(quiz, state), why),
    );
  });
  const text = searching
    ? "These edges wait for their turn. The search takes up the one by which an alignment can be cheapest."
    : "Which of these does the shortest path take? It is the one by which an alignment can be cheapest.";
  return h("div", { class: "fnb-net-leaving" }, h("p", { class: "fnb-muted" }, text), h("ul", {}, ...list));
}
