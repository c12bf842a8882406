import { afterEach, describe, expect, it } from "vitest";
import { unpack } from "../../src/shared/packing.ts";
import { target } from "../../src/solver/links.ts";
import { curveOf, pointOf } from "../../src/solver/network/curves.ts";
import { baseOf, pathArcs, sceneOf } from "../../src/solver/network/scene.ts";
import { type NetworkData, Story, type Subject } from "../../src/solver/network/story.ts";
import { Timeline, type TimelineData } from "../../src/solver/timeline.ts";
import { network } from "../../src/solver/views/network.ts";
import type { Objective } from "../../src/solver/weights.ts";
import { pieceOf, type Shown, show } from "./fixtures.ts";

let one: Shown;
afterEach(() => one?.end());

async function storyOf(
  design: string,
): Promise<{ story: Story; timeline: Timeline; subject: (name: string) => Subject }> {
  const timeline = new Timeline(await unpack<TimelineData>(pieceOf(design, "timeline")));
  const story = new Story(await unpack<NetworkData>(pieceOf(design, "network")), timeline);
  return {
    story,
    timeline,
    subject: (name) => story.subjects.find((own) => own.axis === "x" && own.name === name && own.path) as Subject,
  };
}

const objective = (timeline: Timeline) => timeline.data.objective as unknown as Objective;
const texts = (selector: string): string[] =>
  [...one.view.el.querySelectorAll(selector)].map((element) => element.textContent ?? "");
const letters = (subject: Subject, column: readonly (readonly number[] | null)[]): string =>
  column.map((own, b) => own?.map((n) => subject.bands[b]?.letters[n]?.symbol).join("") || "ε").join("/");

describe("the paper's Figure 8", () => {
  it("has 4 × 6 nodes, and uncut the path C/A, e/BAB, C/A with Ω = 0", async () => {
    const { story, timeline, subject } = await storyOf("figure-8");
    const own = subject("default");
    const base = baseOf(own, objective(timeline), false);
    const nodes = new Set(base.lattice?.nodes.map((node) => node.places.join()));
    expect(nodes.size).toBe(24);
    const choices = { pair: [0, 1] as [number, number], cuts: false, forbidden: true, picked: null };
    const told = story.told(own, timeline.last);
    const scene = sceneOf(story, own, base, told, timeline.last, choices, false);
    expect(scene.size).toEqual([4, 6]);
    const path = scene.arcs.filter((arc) => arc.kind === "path");
    expect(path.map((arc) => letters(own, arc.column))).toEqual(["C/A", "e/BAB", "C/A"]);
    expect(path.reduce((sum, arc) => sum + (arc.omega ?? 9), 0)).toBe(0);
    // The closure of the lattice: an arc from every node to every other that lies right of or below it.
    expect(scene.arcs.filter((arc) => arc.kind !== "path").length).toBe(10 * 21 - 24);
  });

  it("with cuts has five columns, through nodes within e", async () => {
    const { subject } = await storyOf("figure-8");
    const own = subject("default");
    const path = pathArcs(own);
    expect(path.map((arc) => letters(own, arc.column))).toEqual(["C/A", "e/B", "e/A", "e/B", "C/A"]);
    expect(path.map((arc) => pointOf({ pair: [0, 1] }, arc.to)).map(({ x }) => x)).toEqual([1, 2, 3, 4, 5]);
    expect(path.filter((arc) => (arc.to[0] ?? 0) & 1).length).toBe(2);
  });

  it("is what the view says in words", async () => {
    one = await show(network, "figure-8");
    expect(texts(".fnb-net-status")[0]).toMatch(/4 × 6 nodes and 6 within cut letters.*5 columns, Ω = 0 m/);
    const cuts = one.view.controls?.flatMap((own) => [...own.querySelectorAll("input")])[0] as HTMLInputElement;
    cuts.checked = false;
    cuts.dispatchEvent(new Event("change"));
    expect(texts(".fnb-net-status")[0]).toMatch(/4 × 6 nodes,.*The path has 3 columns, Ω = 0 m/);
    expect(texts(".fnb-net-edge[data-path] .fnb-net-column")).toEqual(["CA"]);
  });

  it("says of a forbidden edge which constraint forbids it", async () => {
    one = await show(network, "figure-8");
    const refused = [...one.view.el.querySelectorAll('[data-constraint="C2"]')].map((own) => own.textContent);
    expect(refused.length).toBeGreaterThan(0);
    expect(
      refused.every((text) => /✕ C e.* of “corners” are partly transparent, partly not \(C2\)/.test(text ?? "")),
    ).toBe(true);
  });
});

describe("the tolerance region (supplement, Figure 6)", () => {
  it("of the search is the one that the view traces", async () => {
    const { story, timeline, subject } = await storyOf("figure-8-ida");
    const own = subject("default");
    const base = baseOf(own, objective(timeline), true);
    const told = story.data.regions.filter(
      (region) => region.axis === "x" && region.network === own.network && region.way === "forward",
    );
    expect(told.length).toBeGreaterThan(0);
    let whole = 0;
    for (const region of told) {
      if (region.places.some((place) => place & 1)) continue;
      const scene = (position: number) =>
        sceneOf(
          story,
          own,
          base,
          story.told(own, position),
          position,
          { pair: [0, 1], cuts: true, forbidden: true, picked: region.places },
          false,
        ).delta;
      const [before, after] = [scene(own.first), scene(timeline.last)];
      expect(after?.traced).toBe(true);
      expect(before?.traced).toBe(false);
      whole++;
    }
    expect(whole).toBeGreaterThan(0);
  });

  it("holds the nodes whose runs differ by at most μ, and its pointers take one letter a step", async () => {
    const { story, timeline, subject } = await storyOf("qualifiers-d");
    const own = { ...subject("default"), tolerance: 1 };
    const sized = {
      ...own,
      bands: own.bands.map((band) => ({ ...band, letters: band.letters.filter((a) => a.size !== null) })),
    };
    const base = baseOf(sized, objective(timeline), false);
    const choices = { pair: [0, 1] as [number, number], cuts: false, forbidden: true, picked: [0, 0] };
    const { delta } = sceneOf(story, sized, base, story.told(sized, -1), -1, choices, false);
    if (!delta?.region) throw new Error("no region");
    for (const [i, a] of delta.rows.entries())
      for (const [j, b] of delta.cols.entries()) {
        const inside = j >= (delta.region.first[i] ?? 0) && j <= (delta.region.last[i] ?? -1);
        expect(inside, `${i}, ${j}`).toBe(Math.abs((a ?? 0) - (b ?? 0)) <= 1 + 1e-9);
      }
    for (const walk of [delta.region.lower, delta.region.upper])
      for (let n = 1; n < walk.length; n++) {
        const [p, q] = [walk[n - 1] as [number, number], walk[n] as [number, number]];
        expect(q[0] - p[0] + (q[1] - p[1])).toBe(1);
      }
  });
});

describe("the network while it is searched", () => {
  it("shows what has been expanded, weighed and refused by then, and the path only when it is chosen", async () => {
    const { story, timeline, subject } = await storyOf("residential-house");
    const own = subject("default");
    const choices = { pair: [0, 2] as [number, number], cuts: true, forbidden: true, picked: null };
    const base = baseOf(own, objective(timeline), true);
    let before = -1;
    for (let position = own.first; position <= (own.path?.at ?? 0); position += 7) {
      const told = story.told(own, position);
      const seen = own.at.filter((at) => at <= position).length;
      expect(told.taken.length + told.weighed.length + told.refused.length).toBe(seen);
      expect(seen).toBeGreaterThanOrEqual(before);
      before = seen;
      const scene = sceneOf(story, own, base, told, position, choices, false);
      expect(scene.arcs.some((arc) => arc.kind === "path")).toBe(position >= (own.path?.at ?? 0));
      const latest = told.taken.at(-1);
      if (latest !== undefined && position < (own.path?.at ?? 0)) expect(scene.focus).toEqual(story.placesOf(latest));
    }
    const end = sceneOf(story, own, base, story.told(own, timeline.last), timeline.last, choices, false);
    expect(end.arcs.filter((arc) => arc.kind === "path").length).toBe(own.path?.columns.length);
    for (const arc of end.arcs) for (const { x, y } of curveOf(end, arc)) expect(Number.isFinite(x + y)).toBe(true);
  });

  it("can be asked which edge is next", async () => {
    one = await show(network, "residential-house");
    const stage = one.timeline.data.stages.find((own) => own.axis === "x" && own.stage === "alignment");
    one.go((stage?.first ?? 0) + 120);
    const quiz = one.view.quiz;
    if (!quiz) throw new Error("no quiz");
    quiz.ask(true);
    one.go(one.player.position);
    const radios = [...one.view.el.querySelectorAll<HTMLInputElement>('input[type="radio"]')];
    expect(radios.length).toBeGreaterThan(1);
    expect(one.view.el.textContent).not.toMatch(/the least of all|J ≥/);
    radios[0]?.dispatchEvent(new Event("change"));
    quiz.help();
    const first = quiz.check();
    one.go(one.player.position);
    expect(first.right.length + first.wrong.length).toBe(1);
    const states = [...one.view.el.querySelectorAll<HTMLElement>("[data-verdict]")].map((own) => own.dataset.verdict);
    expect(states.filter((state) => state === "right" || state === "missed").length).toBeGreaterThan(0);
    expect(states.length).toBe(radios.length);
    expect(one.view.el.textContent).toMatch(/the least of all/);
    // What it calls right is what the search does next.
    const { story, timeline } = await storyOf("residential-house");
    const next = story.data.steps.at.findIndex((at, n) => at > one.player.position && story.data.steps.kind[n] === 0);
    const path = story.data.steps.path[next];
    const edge = story.data.steps.path.findIndex((own, n) => own === path && story.data.steps.kind[n] === 1);
    quiz.again();
    one.go(one.player.position);
    const subject = story.subjectAt(one.player.position) as Subject;
    expect(timeline.kindAt(story.data.steps.at[next] ?? 0)).toBe("NodeTaken");
    const key = `${target.edge("x", subject.network, subject.group, story.placesOf(edge), story.columnOf(edge))}>${story
      .afterOf(edge)
      .join(",")}`;
    quiz.choose(key);
    expect(quiz.check().right).toEqual([key]);
  });

  it("hides the path while it asks", async () => {
    one = await show(network, "figure-8");
    one.view.quiz?.ask(true);
    one.go(one.player.position);
    expect(texts(".fnb-net-status")[0]).not.toContain("The path has");
  });
});

describe("a network of more than two words", () => {
  it("shows the path across all of them, to scale, and any two as a pair", async () => {
    one = await show(network, "residential-house");
    expect(texts(".fnb-warp-name").map((text) => text.slice(0, 4))).toEqual(["door", "colu", "base"]);
    expect(one.view.el.querySelectorAll(".fnb-warp-node").length).toBe(8);
    expect(texts(".fnb-net-status")[0]).toMatch(/128 nodes, seen as 4 × 8/);
    one.view.el.querySelector(".fnb-warp-hit")?.dispatchEvent(new Event("click"));
    expect(texts(".fnb-net-status")[0]).toMatch(/seen as 4 × 4/);
  });

  it("lights its columns and letters with the other views", async () => {
    one = await show(network, "residential-house");
    one.links.hover([target.column("x", "default", 3)]);
    one.view.light?.();
    const lit = [...one.view.el.querySelectorAll(".fnb-warp-column[data-lit] title")].map((own) => own.textContent);
    expect(lit).toEqual(["column 4: ω = 0.1 m"]);
    one.links.hover([target.letter("x", "base", 2)]);
    one.view.light?.();
    expect(one.view.el.querySelectorAll(".fnb-warp-letter[data-lit]").length).toBe(1);
  });

  it("looks at the node that is picked, in any view", async () => {
    one = await show(network, "figure-8");
    one.links.pick([target.node("x", 1, 0, [2, 2])]);
    one.view.light?.();
    expect(texts(".fnb-net-leaving h4 code")).toEqual(["eC / BABA"]);
    one.links.pick([]);
    one.view.light?.();
    expect(texts(".fnb-net-leaving h4 code")).toEqual(["CeC / ABABA"]);
  });
});
