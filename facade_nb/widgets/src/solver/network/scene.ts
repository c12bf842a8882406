// What the Network view draws at a moment, as plain data: the lattice of two words, its arcs, the path, the tolerance
// region of the node that is looked at. With more words it is their projection onto two.

import { type Lattice, latticeOf, type Region, traceRegion } from "../lattice.ts";
import type { LetterNote } from "../letters.ts";
import { target } from "../links.ts";
import { Group, type Objective } from "../weights.ts";
import type { Built } from "./building.ts";
import { type Numbers, nodesAt } from "./numbers.ts";
import { type RegionNote, type Story, type Subject, sizeOf, type Told } from "./story.ts";

const NODES = 2_000; // up to so many nodes,
const EDGES = 60_000; // and so many edges, a lattice is listed as a whole
const SMALL = 400; // up to so many edges, those that are forbidden are drawn too
const ARCS = 4_000; // arcs that are drawn at once
const WIDE = 1 << 14; // more than any place
const LIGHT = 240; // of a larger network so many of the lightest permitted edges are drawn

export type ArcKind = "permitted" | "forbidden" | "weighed" | "refused" | "path" | "choice";

export interface Arc {
  kind: ArcKind;
  from: number[];
  to: number[];
  column: (number[] | null)[];
  omega: number | null;
  /** Why it is forbidden. */
  constraint: string;
  text: string;
  /** Targets that it is; number of its column on the path. */
  key: string;
  step: number;
}

export interface SceneNode {
  places: number[];
  /** How often the search has taken it up, or nodes that look like it. */
  taken: number;
  onPath: boolean;
  /** g and f, where the search has told them. */
  numbers?: Numbers | undefined;
}

export interface Delta {
  /** Letters of both words read from the node; what is unlike between them, metres (null: it is elastic). */
  rows: (number | null)[];
  cols: (number | null)[];
  region: Region | null;
  /** The region was told by the search itself. */
  traced: boolean;
}

export interface Scene {
  subject: Subject;
  /** Bands that are drawn downwards (none: -1) and to the right. */
  pair: [number, number];
  down: LetterNote[];
  right: LetterNote[];
  arcs: Arc[];
  nodes: Map<string, SceneNode>;
  /** The node that is looked at. */
  focus: number[] | null;
  /** Whether the search, not the reader, looks at it. */
  searching: boolean;
  delta: Delta | null;
  /** Nodes of the whole letters: the lattice's rows × columns. */
  size: [number, number];
  exact: boolean;
  /** Whether transparent letters may be cut. */
  cutting: boolean;
  leftOut: number;
  alive: Set<string>;
  cut: number[][];
  /** While it is built up: what stands so far. */
  built?: Built;
}

/** A lattice as arcs between places: nodes that differ in what C4 asks of them are one in the drawing. */
export interface Base {
  group: Group;
  lattice: Lattice | null;
  arcs: Arc[];
  /** The shortest path, where letters are not to be cut. */
  shortest: Arc[];
  /** Nodes from the first of which permitted edges lead to them, and on to the end. */
  alive: Set<string>;
  /** Nodes within letters that are cut. */
  cut: number[][];
}

export function baseOf(subject: Subject, objective: Objective, cuts: boolean): Base {
  const group = new Group(subject.bands, subject.canvas, subject.tolerance, objective, cuts);
  const closure = subject.bands.reduce((n, { letters }) => (n * (letters.length + 1) * (letters.length + 2)) / 2, 1);
  if (subject.bands.length > 2 || sizeOf(subject) > NODES || closure > EDGES)
    return { group, lattice: null, arcs: [], shortest: [], alive: new Set(), cut: [] };
  const lattice = latticeOf(group, { nodes: NODES, edges: EDGES });
  const best = new Map<string, Arc & { rank: number }>();
  for (const edge of lattice.edges) {
    const [from, to] = [lattice.nodes[edge.source], lattice.nodes[edge.target]];
    if (!from || !to) continue;
    const column = edge.column.map((option) => option.letters);
    const rank = edge.refusal ? 0 : from.reachable && to.alive ? 2 : 1;
    const key = edgeKey(subject, from.places, column);
    const place = `${key}>${to.places.join()}`;
    if ((best.get(place)?.rank ?? -1) >= rank) continue;
    best.set(place, {
      kind: rank ? "permitted" : "forbidden",
      from: from.places,
      to: to.places,
      column,
      omega: edge.omega,
      constraint: edge.refusal?.constraint ?? "",
      text: rank === 0 ? (edge.refusal?.text() ?? "") : rank === 1 ? "From here the end cannot be come to." : "",
      key,
      step: -1,
      rank,
    });
  }
  const letters = (arc: Arc) => arc.column.reduce((sum, own) => sum + (own?.length ?? 0), 0);
  const arcs = [...best.values()].sort(
    (a, b) => b.rank - a.rank || (a.omega ?? 0) - (b.omega ?? 0) || letters(a) - letters(b),
  );
  const alive = new Set(lattice.nodes.flatMap((node) => (node.alive && node.reachable ? [node.places.join()] : [])));
  const cut = lattice.nodes.filter((node) => node.places.some((place) => place & 1)).map((node) => node.places);
  const distinct = [...new Map(cut.map((places) => [places.join(), places])).values()];
  return { group, lattice, arcs, shortest: cuts ? [] : shortestOf(subject, lattice), alive, cut: distinct };
}

/** The shortest path: least cost (of the objective in use, without what W misses the canvas by), then most columns. */
function shortestOf(subject: Subject, lattice: Lattice): Arc[] {
  const cost = lattice.nodes.map(() => Infinity);
  const columns = lattice.nodes.map(() => 0);
  const by = lattice.nodes.map(() => -1);
  cost[0] = 0;
  for (const [n, edge] of lattice.edges.entries()) {
    const to = lattice.nodes[edge.target];
    if (edge.refusal || !to?.alive || !lattice.nodes[edge.source]?.alive) continue;
    const own = (cost[edge.source] ?? Infinity) + edge.cost;
    const count = (columns[edge.source] ?? 0) + 1;
    const known = cost[edge.target] ?? Infinity;
    if (own < known - 1e-9 || (own < known + 1e-9 && count > (columns[edge.target] ?? 0))) {
      cost[edge.target] = own;
      columns[edge.target] = count;
      by[edge.target] = n;
    }
  }
  const ends = lattice.nodes.flatMap((node, n) =>
    node.alive && node.places.every((place, b) => place === 2 * (subject.bands[b]?.letters.length ?? 0)) ? [n] : [],
  );
  let at = ends.reduce((a, b) => ((cost[b] ?? Infinity) < (cost[a] ?? Infinity) ? b : a), ends[0] ?? -1);
  const path: Arc[] = [];
  while ((by[at] ?? -1) >= 0) {
    const edge = lattice.edges[by[at] as number];
    const from = edge && lattice.nodes[edge.source];
    const to = lattice.nodes[at];
    if (!edge || !from || !to) break;
    const column = edge.column.map((option) => option.letters);
    path.unshift({
      ...PLAIN,
      kind: "path",
      from: from.places,
      to: to.places,
      column,
      omega: edge.omega,
      key: edgeKey(subject, from.places, column),
    });
    at = edge.source;
  }
  return path.map((arc, step) => ({ ...arc, step }));
}

const PLAIN = { constraint: "", text: "", step: -1 };

export const edgeKey = (subject: Subject, places: readonly number[], column: readonly (readonly number[] | null)[]) =>
  target.edge(subject.axis, subject.network, Math.max(0, subject.group), places, column);

export const nodeKey = (subject: Subject, places: readonly number[]) =>
  target.node(subject.axis, subject.network, Math.max(0, subject.group), places);

/** The arcs of the alignment that was chosen. */
export function pathArcs(subject: Subject): Arc[] {
  let from = subject.bands.map(() => 0);
  return (subject.path?.columns ?? []).map((column, step) => {
    const arc: Arc = {
      ...PLAIN,
      kind: "path",
      from,
      to: column.after,
      column: column.letters,
      omega: column.omega,
      key: edgeKey(subject, from, column.letters),
      step,
    };
    from = column.after;
    return arc;
  });
}

export interface Choices {
  pair: [number, number];
  cuts: boolean;
  forbidden: boolean;
  /** The node that the reader has picked. */
  picked: number[] | null;
}

/** A network as it is being built up: without what a search did in it. */
export function sceneBuilt(scene: Scene, built: Built): Scene {
  const { now } = built;
  const drawn = built.arcs.map((arc): Arc => {
    const isCause = now.kind === "arc" && (arc === now.arc || arc === now.parent);
    return isCause ? { ...arc, kind: arc.constraint ? "refused" : "weighed" } : arc;
  });
  const alive = built.done ? scene.alive : built.nodes;
  const cut = scene.cut.filter((places) => built.nodes.has(places.join()));
  return {
    ...scene,
    built,
    arcs: drawn,
    nodes: new Map(),
    focus: null,
    searching: false,
    delta: null,
    alive: new Set(alive),
    cut,
  };
}

export function sceneOf(
  story: Story,
  subject: Subject,
  base: Base,
  told: Told,
  position: number,
  choices: Choices,
  quiet: boolean,
): Scene {
  const [a, b] = choices.pair;
  const shown = (places: readonly number[]) => [places[a] ?? 0, places[b] ?? 0].join();
  const chosen = !!subject.path && subject.path.at <= position && !quiet;
  const nodes = new Map<string, SceneNode>();
  const numbers = nodesAt(story, subject, told, shown);
  const node = (places: number[]): SceneNode => {
    const key = shown(places);
    let own = nodes.get(key);
    if (!own) {
      own = { places, taken: 0, onPath: false, numbers: numbers.get(key) };
      nodes.set(key, own);
    }
    return own;
  };
  const waiting = (step: number) => {
    const after = story.afterOf(step);
    if (after.includes(null)) return;
    const own = numbers.get(shown(after as number[]));
    if (own?.standing === "waiting" && !nodes.has(shown(after as number[]))) node(after as number[]);
  };
  const taken = new Map<number, { step: number; times: number }>();
  for (const step of told.taken) {
    // A step of the player goes over all that was done so far: nothing is made here but what is drawn.
    const at = story.placeOf(step, a) * WIDE + story.placeOf(step, b);
    const own = taken.get(at);
    if (own) own.times++;
    else taken.set(at, { step, times: 1 });
  }
  for (const { step, times } of taken.values()) node(story.placesOf(step)).taken += times;
  if (!quiet) for (const step of told.weighed) waiting(step);
  const path = chosen ? (choices.cuts ? pathArcs(subject) : base.shortest) : [];
  for (const arc of path) for (const places of [arc.from, arc.to]) node(places).onPath = true;

  const current = told.current === undefined ? null : story.placesOf(told.current);
  const searching = !chosen && current !== null && !choices.picked;
  const focus = choices.picked ?? (chosen ? null : current);
  const arcs = arcsOf(story, subject, base, told, choices, { chosen, focus, shown });
  arcs.push(...path);
  const [down, right] = [subject.bands[a]?.letters ?? [], subject.bands[b]?.letters ?? []];
  return {
    subject,
    pair: choices.pair,
    down: a < 0 ? [] : down,
    right,
    arcs,
    nodes,
    focus,
    searching,
    delta: focus && a >= 0 ? deltaOf(story, subject, focus, choices.pair, position) : null,
    size: [a < 0 ? 1 : down.length + 1, right.length + 1],
    exact: base.lattice !== null,
    cutting: choices.cuts,
    leftOut: base.lattice?.leftOut ?? 0,
    alive: base.alive,
    cut: base.cut,
  };
}

function arcsOf(
  story: Story,
  subject: Subject,
  base: Base,
  told: Told,
  choices: Choices,
  at: { chosen: boolean; focus: number[] | null; shown: (places: readonly number[]) => string },
): Arc[] {
  const arcs: Arc[] = [];
  const small = base.arcs.length <= SMALL;
  const focused = at.focus && at.shown(at.focus);
  const own = focused === null ? [] : base.arcs.filter((arc) => at.shown(arc.from) === focused);
  for (const arc of own) if (arcs.length < ARCS && (arc.kind !== "forbidden" || choices.forbidden)) arcs.push(arc);
  // The others are drawn faintly: what is permitted, in a small network also what is forbidden, if no node is looked at.
  let others = 0;
  for (const arc of base.arcs) {
    if (focused !== null && at.shown(arc.from) === focused) continue;
    if (arc.kind === "forbidden" && !(small && focused === null && choices.forbidden)) continue;
    if (!small && arc.text) continue; // it leads nowhere
    if (others++ >= (small ? ARCS : LIGHT)) break;
    arcs.push(arc);
  }
  const exact = base.lattice !== null;
  const seen = new Set<number>();
  const [a, b] = choices.pair;
  const looked = at.focus ? (at.focus[a] ?? 0) * WIDE + (at.focus[b] ?? 0) : -1;
  const draw = (step: number, refused: boolean) => {
    const from = story.placeOf(step, a) * WIDE + story.placeOf(step, b);
    const here = from === looked;
    if (refused ? !here : at.chosen && exact && !here) return;
    const to = story.afterPlaceOf(step, a) * WIDE + story.afterPlaceOf(step, b);
    const line = (from * WIDE * 2 + to) * 2 + Number(refused);
    if (seen.has(line) && !here) return;
    seen.add(line);
    arcs.push(stepArc(story, subject, step, refused ? "refused" : "weighed"));
  };
  for (let k = told.weighed.length - 1; k >= 0 && arcs.length < ARCS; k--) draw(told.weighed[k] as number, false);
  if (choices.forbidden && !exact && looked >= 0)
    for (let k = told.refused.length - 1; k >= 0 && arcs.length < ARCS; k--) draw(told.refused[k] as number, true);
  return arcs;
}

/** A step of the search as an arc; the same arc whenever it is asked for. */
export function stepArc(story: Story, subject: Subject, step: number, kind: "weighed" | "refused"): Arc {
  let known = arcsOfSteps.get(story);
  if (!known) {
    known = new Map();
    arcsOfSteps.set(story, known);
  }
  let arc = known.get(step);
  if (!arc) {
    arc = makeArc(story, subject, step, kind);
    known.set(step, arc);
  }
  return arc;
}

const arcsOfSteps = new WeakMap<Story, Map<number, Arc>>();

function makeArc(story: Story, subject: Subject, step: number, kind: "weighed" | "refused"): Arc {
  const from = story.placesOf(step);
  const column = story.columnOf(step);
  const omega = story.data.steps.omega[step] ?? Number.NaN;
  return {
    kind,
    from,
    to: story.afterOf(step).map((place, b) => place ?? from[b] ?? 0),
    column,
    omega: Number.isNaN(omega) ? null : omega,
    constraint: kind === "refused" ? story.reasonOf(step) : "",
    text: story.textOf(step),
    key: edgeKey(subject, from, column),
    step: -1,
  };
}

/** Running totals of both words from a node, and the region where they differ by at most μ (supplement, Figure 6). */
function deltaOf(
  story: Story,
  subject: Subject,
  focus: readonly number[],
  [a, b]: [number, number],
  position: number,
): Delta {
  const totals = (band: number): (number | null)[] => {
    const place = focus[band] ?? 0;
    let at: number | null = 0;
    const made: (number | null)[] = [0];
    // The rest of a letter that is cut can be as long as it likes.
    for (const [n, letter] of (subject.bands[band]?.letters ?? []).slice(place >> 1).entries()) {
      at = at === null || letter.size === null || (n === 0 && place & 1) ? null : at + letter.size;
      made.push(at);
    }
    return made;
  };
  const [rows, cols] = [totals(a), totals(b)];
  const told = story.data.regions.findLast((own) => matches(own, subject, focus, [a, b], position));
  const rigid = !rows.includes(null) && !cols.includes(null);
  let region: Region | null = null;
  if (rigid) region = traceRegion(rows as number[], cols as number[], subject.tolerance);
  if (told && region) {
    const swap = told.words[0] !== a;
    const turn = (walk: [number, number][]) => (swap ? walk.map(([i, j]): [number, number] => [j, i]) : walk);
    const [lower, upper] = swap ? [told.upper, told.lower] : [told.lower, told.upper];
    region = { ...region, lower: turn(lower), upper: turn(upper) };
  }
  return { rows, cols, region, traced: !!told };
}

function matches(
  own: RegionNote,
  subject: Subject,
  focus: readonly number[],
  pair: [number, number],
  position: number,
): boolean {
  return (
    own.at <= position &&
    own.way === "forward" &&
    own.axis === subject.axis &&
    own.network === subject.network &&
    own.group === subject.group &&
    own.places.join() === focus.join() &&
    own.words.toSorted().join() === pair.toSorted().join()
  );
}

/** Every column that leaves a node of the drawing, those that may come next first. */
export function leaving(story: Story, subject: Subject, base: Base, told: Told, places: readonly number[]): Arc[] {
  if (base.lattice) {
    const at = places.join();
    const own = base.arcs.filter((arc) => arc.from.join() === at);
    return own.sort((x, y) => rankOf(y) - rankOf(x) || (x.omega ?? 9e9) - (y.omega ?? 9e9));
  }
  const arcs = [
    ...stepsAt(story, told.weighed, places).map((step) => stepArc(story, subject, step, "weighed")),
    ...stepsAt(story, told.refused, places).map((step) => stepArc(story, subject, step, "refused")),
  ];
  const distinct = new Map(arcs.map((arc) => [arc.key + arc.to.join(), arc]));
  return [...distinct.values()].sort((x, y) => rankOf(y) - rankOf(x) || (x.omega ?? 9e9) - (y.omega ?? 9e9));
}

const stepsAt = (story: Story, steps: Int32Array, places: readonly number[]): number[] =>
  Array.from(steps.filter((step) => story.isAt(step, places)));

const rankOf = (arc: Arc): number => (arc.constraint ? 0 : arc.text ? 1 : 2);
