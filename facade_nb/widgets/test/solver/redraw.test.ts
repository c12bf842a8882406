// What is drawn when: one frame for all views, those out of sight later, lists that are scrolled without being asked.

import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { unpack } from "../../src/shared/packing.ts";
import { Alternatives } from "../../src/solver/alternatives.ts";
import { Asking } from "../../src/solver/asking.ts";
import { panel } from "../../src/solver/frame.ts";
import { Links } from "../../src/solver/links.ts";
import { Player } from "../../src/solver/player.ts";
import { afterDrawing, cancelFrame, inFrame } from "../../src/solver/redraw.ts";
import { rows } from "../../src/solver/rows.ts";
import type { Session } from "../../src/solver/session.ts";
import { Timeline, type TimelineData } from "../../src/solver/timeline.ts";
import type { ViewKind } from "../../src/solver/view.ts";
import { FakeModel } from "../shared/fake.ts";
import { pieceOf } from "./fixtures.ts";

const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
const rest = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

describe("a frame", () => {
  it("draws everything once, then settles it", async () => {
    const done: string[] = [];
    const settle = () => done.push("settle");
    const draw = () => {
      done.push("draw");
      afterDrawing(settle);
    };
    const other = () => done.push("other");
    const dropped = () => done.push("dropped");
    inFrame(draw);
    inFrame(draw);
    inFrame(dropped);
    inFrame(other);
    cancelFrame(dropped);
    expect(done).toEqual([]);
    await frame();
    expect(done).toEqual(["draw", "other", "settle"]);
    await frame();
    expect(done.length).toBe(3);
  });

  it("goes on where one of the views fails", async () => {
    const told = vi.fn();
    vi.stubGlobal("reportError", told);
    const other = vi.fn();
    inFrame(() => {
      throw new Error("no");
    });
    inFrame(other);
    await frame();
    expect(other).toHaveBeenCalledTimes(1);
    expect(told).toHaveBeenCalledTimes(1);
    vi.unstubAllGlobals();
  });
});

describe("a view that is out of sight", () => {
  let sight: (seen: boolean) => void = () => {};
  const end = new AbortController();

  beforeEach(() => {
    vi.stubGlobal(
      "IntersectionObserver",
      class {
        constructor(callback: (entries: { isIntersecting: boolean }[]) => void) {
          sight = (isIntersecting) => callback([{ isIntersecting }]);
        }
        observe(): void {}
        disconnect(): void {}
      },
    );
  });
  afterEach(() => vi.unstubAllGlobals());

  async function watched() {
    const timeline = new Timeline(await unpack<TimelineData>(pieceOf("figure-7", "timeline")));
    const player = new Player(timeline, 0);
    const shown: number[] = [];
    const kind: ViewKind = {
      title: "A view",
      subtitle: "",
      needs: [],
      make: () => ({ el: document.createElement("p"), show: (position) => shown.push(position) }),
    };
    const session = { live: true } as unknown as Session;
    const links = new Links([]);
    const alternatives = new Alternatives(() => Promise.reject(new Error("none")), timeline, links, end.signal);
    const loaded = { timeline, player, links, alternatives, asking: new Asking() };
    const made = await panel(kind, session, new FakeModel({}), loaded, end.signal);
    return { player, shown, made };
  }

  it("is drawn when it comes into sight, or when the player rests, and then as it is now", async () => {
    const { player, shown, made } = await watched();
    player.go(3);
    await frame();
    expect(shown).toEqual([0, 3]);
    sight(false);
    player.go(4);
    player.go(5);
    await frame();
    expect(shown).toEqual([0, 3]);
    sight(true);
    expect(shown).toEqual([0, 3, 5]);
    sight(false);
    player.go(6);
    await rest(200);
    await frame();
    expect(shown).toEqual([0, 3, 5, 6]);
    made.follow(true); // the page is going to scroll to it
    player.go(7);
    await frame();
    expect(shown).toEqual([0, 3, 5, 6, 7]);
    end.abort();
  });
});

describe("a long list", () => {
  it("shows what is spoken of, wherever it was scrolled to", async () => {
    const end = new AbortController();
    const items = Array.from({ length: 500 }, (_, n) => n);
    const list = rows<number>(
      {
        height: 20,
        most: 10,
        key: String,
        make: (n) => {
          const row = document.createElement("p");
          row.textContent = String(n);
          return row;
        },
      },
      end.signal,
    );
    document.body.append(list.el);
    const seen = () => [...list.el.querySelectorAll("p")].map((row) => Number(row.textContent));
    list.set(items, 300);
    await frame();
    expect(seen()).toContain(300);
    expect(seen().length).toBeLessThan(40);
    expect(list.el.scrollTop).toBe(300.5 * 20 - 100);
    list.el.scrollTop = 0;
    list.el.dispatchEvent(new Event("scroll"));
    expect(seen()[0]).toBe(0);
    list.reveal(499);
    await frame();
    expect(seen()).toContain(499);
    expect(list.el.scrollTop).toBe(490 * 20); // not beyond its end
    end.abort();
  });
});
