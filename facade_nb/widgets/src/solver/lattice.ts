// The alignment decision network of one or two words as a whole (the paper's Figure 8), node by node and edge by edge:
// the browser's twin of facade_nb/solver/trace/lattice.py.

import { EPS, type Group, type Option, type Refusal, refusal, weigh } from "./weights.ts";

export interface LatticeNode {
  /** Per word: twice the letters read, and one more inside a cut letter. */
  places: number[];
  /** Positions with the marks of C4; whether no letter ended there. */
  state: number[];
  owed: boolean;
  /** Permitted edges lead to it from the first node; from it the end can be come to. */
  reachable: boolean;
  alive: boolean;
  least: number;
}

export interface LatticeEdge {
  source: number;
  target: number;
  column: Option[];
  omega: number;
  cost: number;
  width: number;
  refusal: Refusal | null;
}

export interface Lattice {
  nodes: LatticeNode[];
  edges: LatticeEdge[];
  /** Nodes and edges that were too many to be listed. */
  leftOut: number;
}

const placesOf = (state: readonly number[]): number[] => state.map((position) => position >> 2);
const keyOf = (state: readonly number[], owed: boolean): string => `${state.join(",")}|${owed ? 1 : 0}`;

/** Every edge that leaves a node: whole columns of one or two words. */
export function* edgesAt(
  group: Group,
  state: readonly number[],
  owed: boolean,
): Generator<{ column: Option[]; refusal: Refusal | null }> {
  const [first = [], second] = state.map((position, b) => group.elements(b, position));
  for (const [a, own] of first) {
    if (!second) {
      yield { column: [a], refusal: own ?? refusal(group, owed, [a]) };
      continue;
    }
    for (const [b, other] of second) yield { column: [a, b], refusal: own ?? other ?? refusal(group, owed, [a, b]) };
  }
}

/** How many edges the network of one or two words has at least: the closure of its lattice, without cuts. */
export function closureSize(group: Group): number {
  return group.bands.reduce((sum, { letters }) => (sum * (letters.length + 1) * (letters.length + 2)) / 2, 1);
}

/** The network of one or two words, as far as it is not too large. */
export function latticeOf(group: Group, most: { nodes: number; edges: number }): Lattice {
  const nodes: LatticeNode[] = [];
  const edges: LatticeEdge[] = [];
  const number = new Map<string, number>();
  let leftOut = 0;
  const node = (state: number[], owed: boolean): number | undefined => {
    const key = keyOf(state, owed);
    const known = number.get(key);
    if (known !== undefined) return known;
    if (nodes.length >= most.nodes) return undefined;
    number.set(key, nodes.length);
    nodes.push({ places: placesOf(state), state, owed, reachable: false, alive: false, least: Infinity });
    return nodes.length - 1;
  };
  node(group.start, false);
  for (let n = 0; n < nodes.length; n++) {
    const { state, owed } = nodes[n] as LatticeNode;
    for (const made of edgesAt(group, state, owed)) {
      if (made.refusal?.constraint === "empty") continue; // from a node to itself
      const state = made.column.map((option) => option.target);
      const to = node(state, !made.column.some((option) => option.ends));
      if (to === undefined || edges.length >= most.edges) {
        leftOut++;
        continue;
      }
      edges.push({ source: n, target: to, ...weigh(group, made.column), ...made });
    }
  }
  settle(group, nodes, edges);
  return { nodes, edges, leftOut };
}

/** What can be come to, W at least, and edges with which W would become too large. */
function settle(group: Group, nodes: LatticeNode[], edges: LatticeEdge[]): void {
  const read = ({ places, owed }: LatticeNode) => 2 * places.reduce((sum, place) => sum + place, 0) + Number(owed);
  const order = nodes.map(read);
  edges.sort((a, b) => (order[a.source] ?? 0) - (order[b.source] ?? 0) || a.source - b.source);
  const reach = () => {
    for (const own of nodes) own.least = Infinity;
    const [first] = nodes;
    if (first) first.least = 0;
    for (const edge of edges) {
      const [from, to] = [nodes[edge.source], nodes[edge.target]];
      if (!edge.refusal && from && to) to.least = Math.min(to.least, from.least + edge.width);
    }
  };
  reach();
  const rest = group.bands.map(({ letters }) => {
    const least = [0];
    for (const letter of [...letters].reverse()) least.unshift((least[0] ?? 0) + (letter.size ?? 0));
    return least;
  });
  for (const edge of edges) {
    const [from, to] = [nodes[edge.source], nodes[edge.target]];
    if (edge.refusal || !from || !to || from.least === Infinity) continue;
    const still = Math.max(0, ...to.places.map((place, b) => rest[b]?.[(place >> 1) + (place & 1)] ?? 0));
    const over = from.least + edge.width + still - group.canvas - group.tolerance;
    if (over <= EPS) continue;
    const text = () => `W becomes ${Number(over.toPrecision(3))} m larger than canvas + μ at least.`;
    edge.refusal = { constraint: "width", bands: group.bands.map((_, b) => b), letters: [], text };
  }
  reach();
  for (const own of nodes) {
    own.reachable = own.least < Infinity;
    own.alive = own.places.every((place, b) => place === 2 * (group.bands[b]?.letters.length ?? 0));
  }
  for (const edge of edges.toReversed()) {
    const [from, to] = [nodes[edge.source], nodes[edge.target]];
    if (!edge.refusal && from && to?.alive) from.alive = true;
  }
}

export interface Region {
  /** Per letter of the first word, the first and the last of the second with |A − B| ≤ μ; none where first > last. */
  first: number[];
  last: number[];
  /** The nodes that the two pointers pass, as letters read of each. */
  lower: [number, number][];
  upper: [number, number][];
}

/** The tolerance region of two words from a node, traced along its borders (supplement 3.3, its Figure 6). */
export function traceRegion(a: readonly number[], b: readonly number[], mu: number): Region {
  const lower: [number, number][] = [];
  const upper: [number, number][] = [];
  const last = border(a, b, mu + EPS, (i, j) => lower.push([i, j]));
  const beyond = border(b, a, mu + EPS, (j, i) => upper.push([i, j]));
  const first: number[] = [];
  let j = 0;
  for (let i = 0; i < a.length; i++) {
    while (j < b.length && (beyond[j] ?? 0) < i) j++;
    first.push(j);
  }
  return { first, last, lower, upper };
}

function border(
  a: readonly number[],
  b: readonly number[],
  mu: number,
  walk: (i: number, j: number) => void,
): number[] {
  const last: number[] = [];
  let [i, j] = [0, 0];
  while (i < a.length) {
    walk(i, j);
    const inside = (b[j] ?? 0) - (a[i] ?? 0) <= mu;
    if (inside && j + 1 < b.length) {
      j++;
      continue;
    }
    last.push(inside ? j : j - 1);
    i++;
  }
  return last;
}
