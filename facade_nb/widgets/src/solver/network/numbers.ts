// The numbers of a search: g is what is laid, h what is still to come at least, f = g + h what an alignment costs at least
// that goes on so. And how an edge stands: permitted, waiting, expanded, pruned, forbidden.

import { formatNumber } from "../../shared/fields.ts";
import { EPS } from "../weights.ts";
import { PRUNED, type Story, type Subject, type Told } from "./story.ts";

/** permitted: no constraint is against it. waiting: it was weighed. expanded: the edges of its node were made. */
export type Standing = "permitted" | "waiting" | "expanded" | "pruned" | "forbidden";

export interface Numbers {
  g: number;
  f: number | null;
  standing: Standing;
  why: string;
}

export const metres = (value: number): string => String(Number(value.toFixed(3)));

/** `g + h = f` of a node, or g alone where no bound is told. */
export function sum({ g, f }: Pick<Numbers, "g" | "f">): string {
  return f === null ? `g = ${metres(g)}` : `${metres(g)} + ${metres(Math.max(0, f - g))} = ${metres(f)}`;
}

/** What was laid by each path of a network, up to each of its edges. */
const laid = new WeakMap<Subject, Map<number, number>>();
/** The step that made each path. */
const made = new WeakMap<Subject, Map<number, number>>();

function pathsOf(story: Story, subject: Subject): { costs: Map<number, number>; steps: Map<number, number> } {
  let [costs, steps] = [laid.get(subject), made.get(subject)];
  if (!costs || !steps) {
    [costs, steps] = [new Map<number, number>(), new Map<number, number>()];
    const { path, parent, cost, at, network } = story.data.steps;
    const own = subject.network < 0 ? -1 : (network[subject.steps[0] ?? -1] ?? -1);
    const inOrder = Array.from(at.keys()).filter((step) => network[step] === own && (path[step] ?? -1) >= 0);
    for (const step of inOrder) {
      const number = path[step] as number;
      const before = parent[step] ?? -1;
      if (before < 0) {
        if (!costs.has(number)) costs.set(number, cost[step] ?? 0); // a node: it says itself
      } else if (!steps.has(number)) {
        steps.set(number, step);
        costs.set(number, (costs.get(before) ?? 0) + (cost[step] ?? 0));
      }
    }
    laid.set(subject, costs);
    made.set(subject, steps);
  }
  return { costs, steps };
}

/** What is laid with an edge that was weighed, metres. */
export function laidBy(story: Story, subject: Subject, step: number): number {
  return pathsOf(story, subject).costs.get(story.data.steps.path[step] ?? -1) ?? story.data.steps.cost[step] ?? 0;
}

/** Whether an edge was dropped, or has been overtaken by a moment, for another path to the same node. */
export function gone(story: Story, subject: Subject, step: number, position: number): boolean {
  const fate = story.reasonOf(step);
  if (fate !== "overtaken") return fate === "dropped";
  // What overtakes it comes later: until then nobody knows.
  const maker = pathsOf(story, subject).steps.get(story.data.steps.rival[step] ?? -1);
  return maker !== undefined && (story.data.steps.at[maker] ?? 0) <= position;
}

/** Why an edge was pruned, with its numbers. */
function pruned(story: Story, step: number): string {
  const { cost, bound, against } = story.data.steps;
  const [g, f, limit] = [cost[step] ?? Number.NaN, bound[step] ?? Number.NaN, against[step] ?? Number.NaN];
  if (Number.isNaN(f) || Number.isNaN(limit)) return story.textOf(step);
  const least = `at least ${formatNumber(f)} m`;
  switch (story.reasonOf(step)) {
    case "known":
      return `${formatNumber(g)} m so far; another path has come to the same node for ${formatNumber(limit)} m`;
    case "best":
      return `${least}, the best so far is ${formatNumber(limit)} m`;
    case "length":
      return `once its pieces are longer than nothing, more than ${formatNumber(limit)} m`;
    default:
      return `${least}, the limit is ${formatNumber(limit)} m`;
  }
}

/** Numbers of a step that weighed an edge, at a moment. */
function weighed(story: Story, subject: Subject, step: number, position: number, taken: ReadonlySet<number>): Numbers {
  const { steps } = story.data;
  const { costs } = pathsOf(story, subject);
  const path = steps.path[step] ?? -1;
  const g = costs.get(path) ?? steps.cost[step] ?? 0;
  const bound = steps.bound[step] ?? Number.NaN;
  const f = Number.isNaN(bound) ? null : bound;
  const rival = steps.rival[step] ?? -1;
  if (gone(story, subject, step, position)) {
    const other = costs.get(rival);
    const than = other === undefined ? "no more" : `${formatNumber(other)} m`;
    return {
      g,
      f,
      standing: "pruned",
      why: `${formatNumber(g)} m so far; another path has come to the same node for ${than}`,
    };
  }
  return { g, f, standing: path >= 0 && taken.has(path) ? "expanded" : "waiting", why: "" };
}

/** The numbers of what leaves a node, by the edge and where it leads: those of the last time that it was looked at. */
export function edgesAt(
  story: Story,
  subject: Subject,
  told: Told,
  places: readonly number[],
  position: number,
  keyOf: (column: (number[] | null)[], to: readonly (number | null)[]) => string,
): Map<string, Numbers> {
  const { steps } = story.data;
  const found = new Map<string, Numbers>();
  const taken = new Set(Array.from(told.taken, (step) => steps.path[step] ?? -1));
  const here = lastTaken(story, told, places);
  for (const step of told.weighed) {
    if (!story.isAt(step, places)) continue;
    const own = weighed(story, subject, step, position, taken);
    if ((steps.path[step] ?? -1) < 0 && here !== undefined) {
      // The paper's search tells the edge's own cost; whether it was followed is told by its node.
      own.g = (steps.cost[here] ?? 0) + (steps.cost[step] ?? 0);
      const after = story.afterOf(step).map((place, b) => place ?? places[b] ?? 0);
      const next = lastTaken(story, told, after);
      if (next !== undefined) {
        const cost = steps.cost[next] ?? 0;
        if (Math.abs(cost - own.g) < 1e-6) own.f = steps.bound[next] ?? null;
        own.standing = "expanded";
      }
    }
    found.set(keyOf(story.columnOf(step), story.afterOf(step)), own);
  }
  for (const step of told.refused) {
    if (!story.isAt(step, places)) continue;
    const reason = story.reasonOf(step);
    if (!PRUNED.includes(reason)) continue;
    const key = keyOf(story.columnOf(step), story.afterOf(step));
    if (found.get(key)?.standing === "expanded" && reason !== "bound") continue;
    const bound = steps.bound[step] ?? Number.NaN;
    found.set(key, {
      g: steps.cost[step] ?? 0,
      f: Number.isNaN(bound) ? null : bound,
      standing: "pruned",
      why: pruned(story, step),
    });
  }
  return found;
}

function lastTaken(story: Story, told: Told, places: readonly number[]): number | undefined {
  return Array.from(told.taken).findLast((step) => story.isAt(step, places));
}

/** The numbers of all nodes that were expanded or wait, by where two bands stand. */
export function nodesAt(
  story: Story,
  subject: Subject,
  told: Told,
  shown: (places: readonly number[]) => string,
): Map<string, Numbers> {
  const { steps } = story.data;
  const { costs } = pathsOf(story, subject);
  const found = new Map<string, Numbers>();
  for (const step of told.weighed) {
    const bound = steps.bound[step] ?? Number.NaN;
    if (Number.isNaN(bound) || story.reasonOf(step) === "dropped") continue;
    const after = story.afterOf(step);
    if (after.includes(null)) continue;
    const key = shown(after as number[]);
    const known = found.get(key);
    if (known?.f != null && known.f <= bound + EPS) continue;
    found.set(key, { g: costs.get(steps.path[step] ?? -1) ?? 0, f: bound, standing: "waiting", why: "" });
  }
  for (const step of told.taken) {
    const key = shown(story.placesOf(step));
    found.set(key, { g: steps.cost[step] ?? 0, f: steps.bound[step] ?? null, standing: "expanded", why: "" });
  }
  return found;
}
