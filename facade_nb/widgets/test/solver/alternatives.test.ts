// A candidate that is not the layout, chosen: what the trace has of it, in every view.

import { afterEach, describe, expect, it } from "vitest";
import { unpack } from "../../src/shared/packing.ts";
import { Alternatives, bandsOf, type CandidateNote } from "../../src/solver/alternatives.ts";
import { Links, target } from "../../src/solver/links.ts";
import type { NetworkData } from "../../src/solver/network/story.ts";
import { Timeline, type TimelineData } from "../../src/solver/timeline.ts";
import { VIEWS } from "../../src/solver/views/index.ts";
import { DESIGNS, pieceOf, type Shown, show } from "./fixtures.ts";

const piece = <T>(design: string, name: string) => unpack<T>(pieceOf(design, name));

/** What was chosen has come. */
const come = (own: Alternatives) => new Promise<void>((resolve) => own.watch(resolve, new AbortController().signal));

async function chosen(design: string, axis: "x" | "y", number: number) {
  const timeline = new Timeline(await piece<TimelineData>(design, "timeline"));
  const links = new Links([target.candidate(axis, number)]);
  const end = new AbortController();
  const own = new Alternatives((name) => piece(design, name), timeline, links, end.signal);
  await come(own);
  return { own, links, timeline };
}

describe("the words of a candidate", () => {
  it.each(DESIGNS.filter((name) => name !== "contradiction"))(
    "are the bands of the layout's own: %s",
    async (design) => {
      const { paths } = await piece<NetworkData>(design, "network");
      const { events } = await piece<{ events: CandidateNote[] }>(design, "candidates");
      for (const axis of ["x", "y"] as const) {
        const best = events.find((each) => each.axis === axis && each.fate === "best");
        if (!best) continue;
        for (const path of paths.filter((each) => each.axis === axis)) {
          const rows = path.layers.map((_, row) => path.bands.find((band) => band.rows.includes(row))?.letters ?? []);
          expect(bandsOf(rows).map((band) => band.rows)).toEqual(path.bands.map((band) => band.rows));
        }
      }
    },
  );
});

describe("a candidate that Python has named", () => {
  it("is picked with its words, as by a click", async () => {
    const { links } = await chosen("figure-7", "x", 0);
    expect([...links.picked]).toEqual([
      target.candidate("x", 0),
      target.word("x", "balconies", "e B e"),
      target.word("x", "rooms", "A C C C C C A"),
    ]);
    links.toggle([...links.picked]); // a second click lets go of all
    expect([...links.picked]).toEqual([]);
  });
});

describe("a candidate that was aligned", () => {
  it("has its own columns", async () => {
    const { own, timeline } = await chosen("figure-7", "x", 0);
    const found = own.at(timeline.last, "x");
    expect(found?.note.fate).toBe("dearer");
    expect(found?.aligned).toBe(true);
    const [group] = found?.groups ?? [];
    expect(group?.path.columns.length).toBe(found?.note.columns);
    expect(group?.path.error).toBeCloseTo(found?.note.omega ?? -1, 9);
    // Every word stands in it whole, in its order.
    for (const [b, band] of (group?.path.bands ?? []).entries()) {
      const letters = group?.path.columns.flatMap((column) => column.letters[b] ?? []) ?? [];
      expect([...new Set(letters)]).toEqual(band.letters.map((_, n) => n));
    }
  });

  it("shares groups with the layout", async () => {
    const { own, timeline } = await chosen("apartment-house", "x", 1);
    const found = own.at(timeline.last, "x");
    expect(found?.note.fate).toBe("tied");
    expect(found?.groups.map(({ aligned }) => aligned)).toEqual([true, true, true]);
    const columns = found?.groups.reduce((sum, { path }) => sum + path.columns.length, 0);
    expect(columns).toBe(found?.note.columns);
  });
});

describe("a candidate that was not", () => {
  it("says that it was never aligned, and why", async () => {
    const { own, timeline } = await chosen("residential-house", "x", 2);
    const found = own.at(timeline.last, "x");
    expect(found?.aligned).toBe(false);
    expect(found?.name).toBe("Candidate 2 (k = 2)");
    expect(found?.fate).toMatch(/^It was dropped by its bound before it was aligned: .* J ≥ 0.525 m against 0.233 m/);
  });

  it("is shown from the moment on at which it is judged", async () => {
    const { own, timeline } = await chosen("residential-house", "x", 2);
    const at = own.at(timeline.last, "x")?.note.at ?? 0;
    expect(own.at(at, "x")).not.toBeNull();
    expect(own.at(at - 1, "x")).toBeNull();
    expect(own.at(at, "y")).toBeNull();
  });
});

describe("choosing a candidate", () => {
  let one: Shown | undefined;
  afterEach(() => one?.end());

  const seen = async (view: string, design: string, number: number) => {
    const kind = VIEWS[view];
    if (!kind) throw new Error(`no view ${view}`);
    one = await show(kind, design);
    one.links.pick([target.candidate("x", number)]);
    await come(one.alternatives);
    one.go(one.timeline.last);
    return one.view.el;
  };

  it("shows its alignment", async () => {
    const el = await seen("alignment", "figure-7", 0);
    expect(el.querySelector(".fnb-alternative")?.textContent).toContain("Candidate 0 (s = 1, t = 5). It was aligned");
    expect(el.querySelectorAll(".fnb-align-cell").length).toBeGreaterThan(0);
    expect(el.querySelector(".fnb-align-group")?.textContent).toContain("5 columns");
    one?.links.pick([]);
    one?.go(one.timeline.last);
    expect(el.querySelector(".fnb-alternative")).toBeNull();
  });

  it("shows its network", async () => {
    const el = await seen("network", "figure-7", 0);
    expect(el.textContent).toContain("4 × 8 nodes"); // eBe against AC5A
    expect(el.textContent).toContain("The path has 5 columns");
  });

  it("shows its façade", async () => {
    const el = await seen("facade", "residential-house", 2);
    expect(el.textContent).toContain("Candidate 2 (k = 2), not the layout. It was dropped by its bound");
    const copies = el.querySelectorAll(".fnb-traced-other [data-x=A]").length;
    const windows = el.querySelectorAll(".fnb-traced-other [data-x=B]").length;
    expect([copies > windows, windows > 0]).toEqual([true, true]);
    one?.links.hover([target.symbol("B")]);
    one?.view.light?.();
    expect(el.querySelectorAll(".fnb-traced-lit").length).toBe(windows);
    for (const shape of el.querySelectorAll("[data-shape]")) expect(shape.hasAttribute("data-hidden")).toBe(true);
  });

  it("says that sizes of it are not told", async () => {
    const el = await seen("sizing", "residential-house", 2);
    expect(el.querySelector(".fnb-alternative")?.textContent).toContain("this is the system of the layout");
  });

  it("marks its own row only, and the words in it", async () => {
    const el = await seen("candidates", "residential-house", 2);
    one?.links.pick([target.candidate("x", 2), target.word("x", "Cx", "C e C")]); // all of them have that word
    one?.links.apply(el);
    const rows = [...el.querySelectorAll(".fnb-candidate[data-fate]")];
    expect(rows.filter((row) => row.hasAttribute("data-chosen")).length).toBe(1);
    expect(el.querySelectorAll(".fnb-candidate-word[data-chosen]").length).toBe(rows.length);
  });

  it("lasts while its parts are picked", () => {
    const links = new Links([]);
    const [candidate, word, node] = [target.candidate("x", 1), target.word("x", "P", "A"), target.node("x", 1, 0, [2])];
    links.toggle([candidate, word]);
    links.toggle([node]);
    expect([...links.picked]).toEqual([candidate, word, node]);
    links.toggle([node]);
    expect([...links.picked]).toEqual([candidate, word]);
    links.toggle([candidate, word]);
    expect([...links.picked]).toEqual([]);
  });
});
