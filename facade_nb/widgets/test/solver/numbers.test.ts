// The numbers of a search: its course in time, g + h = f of nodes, and why edges are pruned.

import { expect, test } from "vitest";
import { unpack } from "../../src/shared/packing.ts";
import { ledgerOfPath } from "../../src/solver/align/question.ts";
import type { CandidateNote } from "../../src/solver/alternatives.ts";
import { edgesAt, nodesAt, sum } from "../../src/solver/network/numbers.ts";
import { edgeKey } from "../../src/solver/network/scene.ts";
import { type NetworkData, Story, type Subject } from "../../src/solver/network/story.ts";
import { courseOf, Strip } from "../../src/solver/network/strip.ts";
import { Player } from "../../src/solver/player.ts";
import { Timeline, type TimelineData } from "../../src/solver/timeline.ts";
import { Group, type Objective } from "../../src/solver/weights.ts";
import { pieceOf } from "./fixtures.ts";

async function storyOf(design: string) {
  const timeline = new Timeline(await unpack<TimelineData>(pieceOf(design, "timeline")));
  const story = new Story(await unpack<NetworkData>(pieceOf(design, "network")), timeline);
  const subject = story.subjects.find(({ axis, path }) => axis === "x" && path) as Subject;
  return { timeline, story, subject };
}

test("a search has its course: passes with limits, what is proven, the best so far; nothing before it is played", async () => {
  const { timeline, story, subject } = await storyOf("lesson-deepening");
  const { limits, bounds, best, last } = courseOf(story, subject);
  expect(limits.map(([, value]) => Number(value.toFixed(3)))).toEqual([0.97, 1.04, 1.11, 1.25, 1.53, 2.09]);
  expect(best.map(([, value]) => Number(value.toFixed(3)))).toEqual([1.8, 1.55]);
  expect(bounds.at(-1)?.[1]).toBeCloseTo(1.55);
  expect(bounds.every(([, value], n) => n === 0 || value > (bounds[n - 1]?.[1] ?? 0))).toBe(true);

  const player = new Player(timeline, 0);
  const strip = new Strip(story, player);
  strip.show(subject, (best[0]?.[0] ?? 0) - 1);
  expect(strip.el.textContent).toMatch(/Pass 6limit 2.09 mproven: J ≥ 1.53 mbest so far –/);
  expect(strip.el.innerHTML).not.toContain("fnb-strip-best");
  strip.show(subject, last);
  expect(strip.el.textContent).toMatch(/proven: J ≥ 1.55 mbest so far 1.55 m/);
  const track = strip.el.querySelector('[role="slider"]');
  track?.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
  expect(timeline.kindAt(player.position)).toBe("LimitRaised");
});

test("every node that was expanded or waits has its g and h; every pruned edge says why, with numbers", async () => {
  for (const design of ["lesson-table", "lesson-deepening"]) {
    const { story, subject } = await storyOf(design);
    const { data } = story;
    const position = subject.path?.at ?? 0;
    const told = story.told(subject, position);
    const nodes = nodesAt(story, subject, told, (places) => places.join());
    for (const step of told.taken) {
      const own = nodes.get(story.placesOf(step).join());
      expect(own?.standing).toBe("expanded");
      expect((own?.f ?? 0) - (own?.g ?? 0)).toBeGreaterThan(-1e-9);
    }
    expect(sum({ g: 0.4, f: 1.19 })).toBe("0.4 + 0.79 = 1.19");
    const whys: string[] = [];
    for (const places of new Set(Array.from(told.taken, (step) => story.placesOf(step).join()))) {
      const at = places ? places.split(",").map(Number) : [];
      const keyOf = (column: (number[] | null)[], to: readonly (number | null)[]) =>
        `${edgeKey(subject, at, column)}>${to.join()}`;
      for (const own of edgesAt(story, subject, told, at, position, keyOf).values())
        if (own.standing === "pruned") whys.push(own.why);
    }
    expect(whys.length).toBeGreaterThan(10);
    expect(
      whys.filter(
        (why) => !/\d.* m so far; another path has come to the same node for \d|at least \d.* m, the/.test(why),
      ),
    ).toEqual([]);
    if (design === "lesson-table") expect(whys.some((why) => why.includes("another path"))).toBe(true);
    expect(data.limits.length).toBeGreaterThan(1);
  }
});

test("an edge that is overtaken later waits until then", async () => {
  const { story, subject } = await storyOf("lesson-table");
  const { steps } = story.data;
  const step = Array.from(subject.steps).find((own) => story.reasonOf(own) === "overtaken") as number;
  const rival = Array.from(subject.steps).find((own) => steps.path[own] === steps.rival[step] && steps.kind[own] === 1);
  const at = story.placesOf(step);
  const keyOf = (column: (number[] | null)[], to: readonly (number | null)[]) => JSON.stringify([column, to]);
  const standing = (position: number) =>
    edgesAt(story, subject, story.told(subject, position), at, position, keyOf).get(
      keyOf(story.columnOf(step), story.afterOf(step)),
    )?.standing;
  const overtaken = steps.at[rival as number] ?? 0;
  expect(standing(overtaken - 1)).not.toBe("pruned");
  expect(standing(overtaken)).toBe("pruned");
});

test("the ledger's terms add up to the J of the candidate that became the layout", async () => {
  for (const design of ["figure-7", "residential-house", "apartment-house", "qualifiers-d", "lesson-table"]) {
    const { timeline, story } = await storyOf(design);
    const { events } = await unpack<{ events: CandidateNote[] }>(pieceOf(design, "candidates"));
    for (const best of events.filter(({ fate }) => fate === "best")) {
      const paths = story.data.paths.filter(({ axis }) => axis === best.axis);
      const objective = timeline.data.objective as unknown as Objective;
      const ledgers = paths.map((path) =>
        ledgerOfPath(path, new Group(path.bands, path.canvas, path.tolerance, objective)),
      );
      const sum = (of: (own: (typeof ledgers)[number]) => number) => ledgers.reduce((all, own) => all + of(own), 0);
      expect(sum(({ cost }) => cost)).toBeCloseTo(best.cost ?? -1, 9);
      expect(sum(({ omega }) => omega)).toBeCloseTo(best.omega ?? -1, 9);
      expect(sum(({ omega, empty, loose, fit }) => omega + empty + loose + fit)).toBeCloseTo(best.cost ?? -1, 9);
    }
  }
});
