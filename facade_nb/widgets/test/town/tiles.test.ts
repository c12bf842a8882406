import { describe, expect, it } from "vitest";
import { Fitted } from "../../src/town/fitted.ts";
import { COARSE, sideNeeded, type TileInfo, Tiles } from "../../src/town/tiles.ts";
import type { Pixels, Place } from "../../src/town/types.ts";

/** Sizes of a square tile, from a side down to one pixel. */
const sizes = (side: number): Pixels[] =>
  Array.from({ length: Math.log2(side) + 1 }, (_, k) => [side >> k, side >> k] as Pixels);

/** A kernel with these tiles, whose texels all hold the tile's number; `draft`: those that it has not drawn yet. */
function kernel(sides: Record<string, number>, draft = new Set<string>()) {
  return (tiles: Tiles, asked: { names: string[]; upto: number }) => {
    const told: TileInfo[] = [];
    const data: Uint8Array[] = [];
    for (const name of asked.names) {
      const small = draft.has(name) && asked.upto <= COARSE;
      if (!small) draft.delete(name);
      const own = sizes(small ? COARSE : (sides[name] as number));
      const above = tiles.above(name);
      const first = own.findIndex(([side]) => side <= asked.upto);
      const found = own.findIndex(([side]) => side <= above);
      const end = found < 0 ? own.length : found;
      told.push({ name, sizes: own, first, end, grey: name === "a", draft: small });
      const number = 1 + Object.keys(sides).indexOf(name);
      for (const [w, h] of own.slice(first, end)) data.push(new Uint8Array(4 * w * h).fill(number));
    }
    tiles.receive(told, new Uint8Array(Buffer.concat(data)));
  };
}

const SIDES = { a: 256, b: 128, c: 256 };

function all(tiles: Tiles, answer: ReturnType<typeof kernel>, side: number): { names: string[]; upto: number }[] {
  const every = [];
  for (let next = tiles.next(side, 1e9); next; next = tiles.next(side, 1e9)) {
    every.push(next);
    answer(tiles, next);
  }
  return every;
}

describe("tiles", () => {
  it("come coarse first, then as fine as is needed, each size once", () => {
    const tiles = new Tiles();
    tiles.take(["a", "b", "c"]);
    expect(tiles.complete).toBe(0);
    const answer = kernel(SIDES);
    expect(all(tiles, answer, COARSE)).toEqual([{ names: ["a", "b", "c"], upto: COARSE }]);
    expect(tiles.complete).toBe(COARSE);
    expect(tiles.whole).toBe(false);
    expect(all(tiles, answer, 64)).toEqual([{ names: ["a", "b", "c"], upto: 64 }]);
    expect(tiles.complete).toBe(64);
    const rest = all(tiles, answer, Infinity);
    expect(rest.map(({ names, upto }) => `${names} ${upto}`)).toEqual(["a,b,c 128", "a,c 256"]);
    expect(tiles.complete).toBe(256);
    expect(tiles.whole).toBe(true);
    expect(tiles.bytes[0]).toBe(tiles.bytes[1]);
  });

  it("that were drawn in haste are replaced, few in a message", () => {
    const tiles = new Tiles();
    const sides = Object.fromEntries(Array.from({ length: 14 }, (_, k) => [`t${k}`, 64]));
    tiles.take(Object.keys(sides));
    const answer = kernel(sides, new Set(Object.keys(sides)));
    answer(tiles, tiles.next(COARSE, 1e9) as never);
    expect(tiles.complete).toBe(COARSE);
    expect(tiles.whole).toBe(false);
    const before = tiles.version;
    expect(all(tiles, answer, Infinity).map(({ names }) => names.length)).toEqual([6, 6, 2]);
    expect(tiles.whole).toBe(true);
    expect(tiles.version).toBeGreaterThan(before);
  });

  it("fill an image that never takes more than its bound, nor more pixels a side than the card has", () => {
    const tiles = new Tiles();
    tiles.take(["a", "b", "c"]);
    all(tiles, kernel(SIDES), Infinity);
    for (const [bytes, most] of [
      [1e9, 1 << 14],
      [300_000, 1 << 14],
      [1e9, 300],
      [20_000, 1 << 14],
      [1e9, 64],
    ] as const) {
      const side = tiles.sideFor(Infinity, bytes, most);
      const { atlas } = tiles.arranged(side);
      expect(atlas.content.length).toBeLessThanOrEqual(bytes);
      expect(Math.max(...atlas.image.size)).toBeLessThanOrEqual(most);
      const next = tiles.arranged(2 * side).atlas; // one more would not do
      if (side < 256) expect(next.content.length > bytes || Math.max(...next.image.size) > most).toBe(true);
    }
  });

  it("stand where the table says, and begin with the largest that is shown", () => {
    const tiles = new Tiles();
    tiles.take(["a", "b", "c"]);
    all(tiles, kernel(SIDES), Infinity);
    for (const side of [256, 64, 1]) {
      const { atlas, tile_table } = tiles.arranged(side);
      const [columns, rows] = tile_table.image.size;
      expect(rows).toBe(3);
      const table = new Float32Array(tile_table.content.buffer);
      for (let tile = 0; tile < 3; tile += 1) {
        const row = table.subarray(4 * columns * tile, 4 * columns * (tile + 1));
        expect(row[0]).toBe(Number(tile === 0));
        expect(row[6]).toBe(Math.min(side, SIDES[["a", "b", "c"][tile] as "a"]));
        for (let k = 1; k < columns; k += 1) {
          const [x, y, w, h] = row.subarray(4 * k, 4 * k + 4) as unknown as [number, number, number, number];
          for (const [px, py] of [
            [x, y],
            [x + w - 1, y + h - 1],
          ] as const)
            expect(atlas.content[4 * (py * atlas.image.size[0] + px)]).toBe(tile + 1);
        }
      }
    }
  });

  it("are an image of one pixel where a grammar names none", () => {
    const tiles = new Tiles();
    tiles.take([]);
    expect(tiles.complete).toBe(COARSE);
    expect(tiles.whole).toBe(true);
    expect(tiles.arranged(COARSE).atlas.image.size).toEqual([1, 1]);
  });

  it("of another grammar stay, where it names them too", () => {
    const tiles = new Tiles();
    tiles.take(["a", "b"]);
    all(tiles, kernel(SIDES), Infinity);
    expect(tiles.lacking(["b", "c"])).toEqual(["c"]);
    tiles.take(["b", "c"]);
    expect(all(tiles, kernel(SIDES), Infinity).every(({ names }) => `${names}` === "c")).toBe(true);
  });
});

describe("the card's tiles", () => {
  const bounds = { bytes: 1e9, most: 1 << 14 };
  const side = (fitted: Fitted) => {
    const { tile_table } = fitted.images as NonNullable<typeof fitted.images>;
    return new Float32Array(tile_table.content.buffer)[6];
  };
  it("grow by one size at a time in motion, at once at rest, and shrink late", () => {
    const tiles = new Tiles();
    const fitted = new Fitted();
    tiles.take(["a", "c"]);
    expect(fitted.fit(tiles, 256, bounds, false)).toBe(false); // nothing has come
    const answer = kernel(SIDES);
    all(tiles, answer, COARSE);
    expect(fitted.fit(tiles, 256, bounds, false)).toBe(true);
    expect(side(fitted)).toBe(32);
    all(tiles, answer, Infinity);
    const told = [0, 1, 2, 3, 4].map(() => (fitted.fit(tiles, 256, bounds, true) ? side(fitted) : 0));
    expect(told).toEqual([64, 128, 256, 0, 0]);
    expect(fitted.fit(tiles, 128, bounds, true)).toBe(false); // it may need them again soon
    expect(fitted.fit(tiles, 64, bounds, true)).toBe(true);
    expect(side(fitted)).toBe(64);
    expect(fitted.fit(tiles, 256, bounds, false)).toBe(true);
    expect(side(fitted)).toBe(256);
  });
  it("are those of another grammar at once", () => {
    const tiles = new Tiles();
    const fitted = new Fitted();
    tiles.take(["a"]);
    all(tiles, kernel(SIDES), Infinity);
    fitted.fit(tiles, 256, bounds, false);
    expect(fitted.of(tiles)).toBe(true);
    tiles.take(["c", "a"]);
    expect(fitted.of(tiles)).toBe(false);
    all(tiles, kernel(SIDES), Infinity);
    expect(fitted.fit(tiles, 256, bounds, true)).toBe(true);
    expect(fitted.of(tiles)).toBe(true);
  });
});

describe("the side that a view needs", () => {
  const low = [0, 0, 0];
  const high = [100, 20, 100];
  const from = (height: number): Place => [50, height, 50, 0, -90, 60];
  it("is the largest among houses, and falls with the height", () => {
    const sides = [10, 40, 120, 300, 1200].map((height) => sideNeeded(from(height), 1000, low, high));
    expect(sides[0]).toBeGreaterThanOrEqual(2048);
    expect(sides).toEqual([...sides].sort((a, b) => b - a));
    expect(sides.at(-1)).toBe(COARSE);
    for (const side of sides) expect(Math.log2(side) % 1).toBe(0);
  });
  it("grows with the picture", () => {
    expect(sideNeeded(from(120), 2000, low, high)).toBe(2 * sideNeeded(from(120), 1000, low, high));
  });
});
