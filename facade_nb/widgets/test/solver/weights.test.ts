// The browser's twin of the solver's weighing against the solver itself: tests/widgets/solver/pieces.py asks it.

import { describe, expect, it } from "vitest";
import { unpack } from "../../src/shared/packing.ts";
import { latticeOf } from "../../src/solver/lattice.ts";
import type { TimelineData } from "../../src/solver/timeline.ts";
import { type BandNote, Group, judge, type Objective } from "../../src/solver/weights.ts";
import { pieceOf } from "./fixtures.ts";

type Edge = [number[], number[], number[][], number, number, number, string, string, number];
interface Oracle {
  lattices: { axis: string; group: string; edges: Edge[] }[];
  judged: {
    axis: string;
    group: string;
    columns: number[][][];
    verdicts: [number, number, number, string, string][] | null;
  }[];
}
interface Path {
  axis: string;
  group: string;
  bands: BandNote[];
  canvas: number;
  tolerance: number;
}

async function groupsOf(design: string): Promise<{ oracle: Oracle; group: (axis: string, name: string) => Group }> {
  const { paths } = await unpack<{ paths: Path[] }>(pieceOf(design, "alignment"));
  const timeline = await unpack<TimelineData>(pieceOf(design, "timeline"));
  return {
    oracle: await unpack<Oracle>(pieceOf(design, "oracle")),
    group(axis, name) {
      const own = paths.find((path) => path.axis === axis && path.group === name) as Path;
      return new Group(own.bands, own.canvas, own.tolerance, timeline.objective as unknown as Objective);
    },
  };
}

const DESIGNS = ["figure-7", "figure-7-paper", "figure-8", "residential-house", "apartment-house", "qualifiers-d"];

describe.each(DESIGNS)("columns of %s", (design) => {
  it("weigh what Python says, and break what it says, on every edge of the lattice", async () => {
    const { oracle, group } = await groupsOf(design);
    let compared = 0;
    for (const { axis, group: name, edges } of oracle.lattices) {
      if (!edges.length) continue;
      const made = latticeOf(group(axis, name), { nodes: 10_000, edges: 100_000 });
      const key = (source: readonly number[], target: readonly number[], column: readonly (readonly number[])[]) =>
        JSON.stringify([source, target, column]);
      const state = (n: number) => {
        const node = made.nodes[n];
        return [...(node?.state ?? []), Number(node?.owed)];
      };
      const own = new Map(
        made.edges.map((edge) => [
          key(
            state(edge.source),
            state(edge.target),
            edge.column.map((option) => option.letters),
          ),
          edge,
        ]),
      );
      expect(own.size).toBe(edges.length);
      for (const [source, target, column, omega, cost, width, constraint, text, mark] of edges) {
        const edge = own.get(key(source, target, column));
        if (!edge) throw new Error(`no edge ${key(source, target, column)}`);
        expect(edge.omega).toBeCloseTo(omega, 9);
        expect(edge.cost).toBeCloseTo(cost, 9);
        expect(edge.width).toBeCloseTo(width, 9);
        expect([edge.refusal?.constraint ?? "", edge.refusal?.text() ?? ""]).toEqual([constraint, text]);
        const node = made.nodes[edge.source];
        expect(Number(node?.reachable) + 2 * Number(node?.alive)).toBe(mark);
        compared++;
      }
    }
    expect(compared).toBeGreaterThan(0);
  });

  it("are judged as Python judges alignments that somebody made up", async () => {
    const { oracle, group } = await groupsOf(design);
    const outcomes = new Set<string>();
    for (const { axis, group: name, columns, verdicts } of oracle.judged) {
      const own = judge(group(axis, name), columns);
      if (!verdicts) {
        expect(own, JSON.stringify(columns)).toBeNull();
        outcomes.add("not an alignment");
        continue;
      }
      expect(own?.length).toBe(verdicts.length);
      for (const [j, [omega, cost, width, constraint, text]] of verdicts.entries()) {
        expect(own?.[j]?.omega).toBeCloseTo(omega, 9);
        expect(own?.[j]?.cost).toBeCloseTo(cost, 9);
        expect(own?.[j]?.width).toBeCloseTo(width, 9);
        expect([own?.[j]?.refusal?.constraint ?? "", own?.[j]?.refusal?.text() ?? ""]).toEqual([constraint, text]);
        outcomes.add(constraint);
      }
    }
    expect(outcomes.size, [...outcomes].join()).toBeGreaterThan(2);
  });
});
