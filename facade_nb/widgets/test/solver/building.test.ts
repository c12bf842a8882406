// A network comes about part by part, each with its reason; in the end it is the whole.

import { describe, expect, it } from "vitest";
import { unpack } from "../../src/shared/packing.ts";
import { builtUp, type Part, partsOf, tell } from "../../src/solver/network/building.ts";
import { baseOf } from "../../src/solver/network/scene.ts";
import { type NetworkData, Story } from "../../src/solver/network/story.ts";
import { Timeline, type TimelineData } from "../../src/solver/timeline.ts";
import type { Objective } from "../../src/solver/weights.ts";
import { pieceOf } from "./fixtures.ts";

async function built(cuts: boolean) {
  const timeline = new Timeline(await unpack<TimelineData>(pieceOf("figure-8", "timeline")));
  const story = new Story(await unpack<NetworkData>(pieceOf("figure-8", "network")), timeline);
  const subject = story.subjects.find(({ axis, bands }) => axis === "x" && bands.length === 2);
  if (!subject) throw new Error("no network of two words");
  const base = baseOf(subject, timeline.data.objective as unknown as Objective, cuts);
  return { subject, base, parts: partsOf(subject, base) };
}

const kinds = (parts: readonly Part[]): string[] => parts.map(({ kind }) => kind);

describe("a network that is built up", () => {
  it.each([true, false])("has its nodes first, then steps, then the closure; cut letters: %s", async (cuts) => {
    const { base, parts } = await built(cuts);
    const order = kinds(parts).filter((kind, n, all) => kind !== all[n - 1]);
    expect(order).toEqual(["node", "step", "arc", "end"]);
    const places = new Set(base.lattice?.nodes.map((own) => own.places.join()));
    expect(kinds(parts).filter((kind) => kind === "node")).toHaveLength(places.size);
    if (!cuts) expect([places.size, kinds(parts).filter((kind) => kind === "step").length]).toEqual([24, 38]); // Figure 8
    const all = builtUp(parts, parts.length);
    expect(all.done).toBe(true);
    expect(new Set(all.arcs)).toEqual(new Set(base.arcs.filter(({ column }) => column.some((own) => own?.length))));
  });

  it("lets an arc follow only from what stands already", async () => {
    const { parts } = await built(false);
    for (const [n, part] of parts.entries()) {
      if (part.kind !== "arc") continue;
      const before = builtUp(parts, n);
      if (part.parent) expect(before.arcs).toContain(part.parent);
      if (part.step) expect(before.segments).toContain(part.step);
      expect(part.parent?.from ?? part.arc.from).toEqual(part.arc.from);
      expect(before.nodes.has(part.arc.to.join())).toBe(true);
    }
    const followed = parts.filter((part) => part.kind === "arc" && part.parent);
    expect(followed.length).toBeGreaterThan(100);
  });

  it("says the reason of every part in words", async () => {
    const { subject, base, parts } = await built(true);
    const texts = parts.map((part) => tell(subject, base, part));
    expect(texts[0]).toMatch(/^The first node: nothing is read\. CeC of corners and ABABA of walls are left\.$/);
    const arcs = texts.filter((_, n) => parts[n]?.kind === "arc");
    for (const text of arcs) expect(text).toMatch(/ (Permitted: no constraint is against it|Forbidden: .+\.)/);
    expect(texts.some((text) => /follows from .*, which is there, and the step that reads/.test(text))).toBe(true);
    expect(texts.at(-1)).toContain("That is the whole network");
  });
});
