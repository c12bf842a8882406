import { deflateSync } from "node:zlib";
import { describe, expect, it } from "vitest";
import { bytesOf } from "../../src/shared/packing.ts";
import { brief, rangeOf } from "../../src/town/buffers.ts";
import { moved, turned } from "../../src/town/flying.ts";
import { Held } from "../../src/town/held.ts";
import { Loading, type Reply } from "../../src/town/loading.ts";
import { coarser, FACTORS } from "../../src/town/painting.ts";
import { buildingOf, seedOf } from "../../src/town/session.ts";
import type { Head, Place } from "../../src/town/types.ts";

const HERE: Place = [10, 20, 30, 90, 0, 60];

describe("a key", () => {
  it("goes where one looks: east, at a yaw of 90", () => {
    const [x, y, z] = moved(HERE, { ahead: 1000 }, false);
    expect(x).toBeGreaterThan(20);
    expect(y).toBe(20);
    expect(z).toBeCloseTo(30, 6);
    expect(moved(HERE, { right: 1000 }, false)[2]).toBeGreaterThan(40); // south lies on the right
  });
  it("goes four times as far with Shift, and back by the other one", () => {
    const far = (place: Place) => place[0] - HERE[0];
    expect(far(moved(HERE, { ahead: 100 }, true))).toBeCloseTo(4 * far(moved(HERE, { ahead: 100 }, false)));
    expect(moved(moved(HERE, { ahead: 100 }, false), { back: 100 }, false)[0]).toBeCloseTo(10, 6);
  });
  it("follows the ground on foot, however one looks", () => {
    const [, y] = moved([0, 1.7, 0, 0, 40, 60], { ahead: 1000, up: 1000 }, false, 1.7);
    expect(y).toBe(1.7);
  });
  it("does not go below the ground", () => {
    expect(moved([0, 1, 0, 0, -80, 60], { ahead: 9000, down: 9000 }, true)[1]).toBe(0.6);
  });
});

describe("a press", () => {
  it("moves one as long as it lasted, however its frames come", () => {
    for (const frames of [[110, 150, 260, 300], [500], [100, 190, 500]]) {
      const held = new Held();
      held.press("ahead", 100);
      let gone = 0;
      for (const [k, now] of frames.entries()) {
        if (k === frames.length - 1) held.release("ahead", 280);
        gone += held.take(now).ahead ?? 0;
      }
      expect(gone).toBe(180);
      expect(held.moving).toBe(false);
    }
  });
  it("moves one a little though it was let go before a frame came, be the frame ever so late", () => {
    for (const now of [99, 101, 140, 900]) {
      const held = new Held();
      held.press("up", 100);
      held.release("up", 101);
      expect(held.take(now)).toEqual({ up: 60 });
      expect(held.moving).toBe(false);
    }
  });
  it("is one press while the keyboard repeats it; of a frame that hangs not all is gone", () => {
    const held = new Held();
    held.press("left", 0);
    expect(held.take(10)).toEqual({ left: 10 });
    held.press("left", 12);
    expect(held.take(20)).toEqual({ left: 10 });
    expect(held.take(5020)).toEqual({ left: 250 });
    held.releaseAll(5025);
    expect(held.take(5040)).toEqual({ left: 5 });
  });
});

describe("dragging", () => {
  it("takes the town with it, and never turns one upside down", () => {
    expect(turned(HERE, 100, 0, 600)[3]).toBeCloseTo(80, 6);
    expect(turned(HERE, 0, 9000, 600)[4]).toBe(89);
    expect(turned(HERE, 0, -9000, 600)[4]).toBe(-89);
  });
});

describe("how coarse a frame is", () => {
  it("grows with its time, and falls when there is time", () => {
    expect(coarser(1, 48)).toBe(1);
    expect(coarser(1, 190)).toBeGreaterThanOrEqual(2);
    expect(coarser(4, 5000)).toBe(12);
    expect(coarser(8, 3)).toBeLessThan(8);
    expect(coarser(4, 40)).toBe(4);
    expect(coarser(1, 2)).toBe(1);
  });
  it("is always one of the known ones, and settles", () => {
    for (const pixel of [1e-5, 1e-3, 1e-2]) {
      let factor = 4;
      for (let k = 0; k < 20; k += 1) factor = coarser(factor, 8 + (pixel * 256_000) / factor ** 2);
      expect(FACTORS).toContain(factor);
      expect(coarser(factor, 8 + (pixel * 256_000) / factor ** 2)).toBe(factor);
    }
  });
});

describe("the building at a pixel", () => {
  it("is the one whose seed the wall carries", () => {
    const seeds = Int32Array.from([64, 128, 1, 2, 1048575, 0]);
    for (const own of [0, 1, 2]) expect(buildingOf(seeds, ...seedOf(seeds, own))).toBe(own);
    expect(buildingOf(seeds, 0, 0)).toBe(-1);
  });
});

describe("values", () => {
  it("are told briefly", () => {
    expect([0, 1.5, 12.345678, 123456, 0.00002].map(brief)).toEqual(["0", "1.5", "12.346", "1.2e+5", "2.0e-5"]);
  });
  it("are shown between nearly all of their own; of depths what is infinitely far is left out", () => {
    const values = Float32Array.from(Array.from({ length: 100 }, (_, k) => [k < 50 ? 1 : 0.5, 0, 0, 0]).flat());
    expect(rangeOf(values, true)).toMatchObject({ mode: 3, low: [0.5, 0, 0, 0], high: [0.5, 0, 0, 0] });
    expect(rangeOf(values, false).high?.[0]).toBe(1);
  });
});

describe("what is loaded", () => {
  const deflate = (bytes: Uint8Array) => new Uint8Array(deflateSync(bytes));
  const head = {
    chunks: {
      first: Int32Array.from([0, 3, 6]),
      count: Int32Array.from([3, 3, 3]),
      low: Float32Array.from([0, 0, 0, 900, 0, 0, 300, 0, 0]),
      high: Float32Array.from([9, 9, 9, 909, 9, 9, 309, 9, 9]),
      needs: Int32Array.from([0, 1, 2, 4]),
      blocks: Int32Array.from([0, 1, 0, 2]),
    },
    blobs: {
      vertices: { bytes: 30, block: 10, version: 0 },
      indices: { bytes: 36, block: 36, version: 0 },
      edges: { bytes: 4, block: 4, version: 0 },
    },
    tiles: [],
  } as unknown as Head;

  it("is asked for once, what is near first; a chunk is there when all its blocks are", async () => {
    const asked: { name: string; version: number; blocks: number[] }[] = [];
    const come: string[] = [];
    const loading = new Loading(
      (message) => asked.push(message as never),
      (name, at, end) => come.push(`${name} ${at} ${end}`),
    );
    loading.take(head);
    loading.ask(HERE);
    expect(asked.map(({ name }) => name)).toEqual(["indices", "vertices"]);
    for (let k = 0; k < asked.length; k += 1) {
      const { name, version, blocks } = asked[k] as (typeof asked)[number];
      const info = head.blobs[name] as { bytes: number; block: number };
      const buffers = blocks.map((block) =>
        deflate(new Uint8Array(Math.min(info.block, info.bytes - block * info.block)).fill(k + 1)),
      );
      await loading.receive({ kind: "blocks", name, version, blocks, client: "" } as Reply, buffers);
      loading.ask(HERE);
    }
    const vertices = asked.filter(({ name }) => name === "vertices").flatMap(({ blocks }) => blocks);
    expect(vertices[0]).toBe(0);
    expect([...vertices].sort()).toEqual([0, 1, 2]);
    expect(new Set(asked.map(({ name, blocks }) => `${name} ${blocks}`)).size).toBe(asked.length);
    expect(loading.part).toBe(1);
    expect([0, 1, 2].every((chunk) => loading.has(chunk))).toBe(true);
    expect(come).toContain("vertices 20 30");
    loading.take({ ...head, blobs: { ...head.blobs, edges: { bytes: 4, block: 4, version: 2 } } } as Head);
    expect(loading.whole("edges")).toBe(false); // it is asked for anew
    expect(loading.whole("vertices")).toBe(true);
  });

  it("takes bytes as hosts hand them over", () => {
    const bytes = Uint8Array.from([9, 1, 2, 3]);
    expect([...bytesOf(new DataView(bytes.buffer, 1, 2))]).toEqual([1, 2]);
    expect([...bytesOf(bytes.buffer)]).toEqual([9, 1, 2, 3]);
  });
});
