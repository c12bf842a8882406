// The tiles that a grammar names: each comes in the sizes that are asked for, and the card gets an image of them that is as
// fine as the view needs and a bound allows.

import type { Image, Pixels, Place } from "./types.ts";

/** The side of the sizes that come first. */
export const COARSE = 32;
const EXTENT = 8; // metres that a tile covers at most, but for a few that are plain
const RGBA = 4;

/** What Python tells of a tile whose sizes from `first` to before `end` it sends. */
export interface TileInfo {
  name: string;
  sizes: Pixels[];
  first: number;
  end: number;
  grey: boolean;
  /** It was drawn small, in haste, and is to be replaced. */
  draft: boolean;
}

export interface TileReply {
  kind: "tiles";
  client: string;
  tiles: TileInfo[];
}

interface Tile {
  info: TileInfo;
  levels: (Uint8Array | undefined)[];
}

export interface Texture {
  image: Image;
  content: Uint8Array;
}

const sideOf = ([width, height]: Pixels): number => Math.max(width, height);

/** Places on shelves, the highest first, and the size of all. */
function shelved(sizes: Pixels[]): { places: Pixels[]; size: Pixels } {
  const order = [...sizes.keys()].sort(
    (a, b) => (sizes[b] as Pixels)[1] - (sizes[a] as Pixels)[1] || (sizes[b] as Pixels)[0] - (sizes[a] as Pixels)[0],
  );
  const area = sizes.reduce((sum, [w, h]) => sum + w * h, 0);
  const widest = Math.max(1, ...sizes.map(([w]) => w));
  const wide = widest * Math.max(1, Math.ceil(Math.sqrt(area) / widest));
  const places: Pixels[] = sizes.map(() => [0, 0]);
  let [x, y, shelf] = [0, 0, 0];
  for (const k of order) {
    const [w, h] = sizes[k] as Pixels;
    if (x + w > wide) [x, y, shelf] = [0, y + shelf, 0];
    shelf = Math.max(shelf, h);
    places[k] = [x, y];
    x += w;
  }
  return { places, size: [wide, Math.max(1, y + shelf)] };
}

export class Tiles {
  private names: string[] = [];
  private readonly here = new Map<string, Tile>();
  private readonly asked = new Map<string, number>();
  /** Counts what has come for good. */
  version = 0;

  /** Take the names of a grammar's tiles, in its order. */
  take(names: string[]): void {
    if (names.join("\n") === this.names.join("\n")) return;
    this.names = names;
    this.version += 1;
  }

  /** Those of some names of which nothing has come. */
  lacking(names: string[]): string[] {
    return names.filter((name) => !this.here.has(name));
  }

  /** The side up to which all of a tile has come; `Infinity`: all. */
  private had(name: string): number {
    const tile = this.here.get(name);
    if (!tile || tile.info.draft) return 0;
    const first = tile.levels.findIndex((level) => level !== undefined);
    return first === 0 ? Infinity : first < 0 ? 0 : sideOf(tile.info.sizes[first] as Pixels);
  }

  /** The side up to which a tile need not be sent again. */
  above(name: string): number {
    const had = this.had(name);
    return Number.isFinite(had) ? had : 0;
  }

  /** The largest side up to which all tiles have come, of those there are; 0: of some nothing has come. */
  get complete(): number {
    if (this.lacking(this.names).length) return 0;
    const least = Math.min(...this.names.map((name) => Math.max(COARSE, this.had(name))));
    return Math.min(least, this.largest);
  }

  /** The side of the largest tile that is known of. */
  get largest(): number {
    let most = COARSE;
    for (const name of this.names) {
      const tile = this.here.get(name);
      if (tile) most = Math.max(most, ...tile.info.sizes.map(sideOf));
    }
    return most;
  }

  /** Whether every size of every tile has come. */
  get whole(): boolean {
    return this.names.every((name) => this.had(name) === Infinity);
  }

  /** Bytes that have come, of those that there are, as far as is known. */
  get bytes(): [here: number, all: number] {
    let [here, all] = [0, 0];
    for (const name of this.names) {
      const tile = this.here.get(name);
      if (!tile) {
        all += RGBA * COARSE * COARSE;
        continue;
      }
      tile.info.sizes.forEach(([w, h], k) => {
        all += RGBA * w * h;
        if (tile.levels[k] && !tile.info.draft) here += RGBA * w * h;
      });
    }
    return [here, all];
  }

  /** Some that lack sizes up to a side, as many as a message of so many bytes holds; they count as asked for. */
  next(side: number, room: number): { names: string[]; upto: number } | null {
    for (let upto = COARSE; ; upto *= 2) {
      const lacks = this.names.filter((name) => {
        const draft = upto <= COARSE && this.here.get(name)?.info.draft === true;
        return draft ? this.asked.get(name) !== -1 : this.had(name) < upto && (this.asked.get(name) ?? 0) < upto;
      });
      if (lacks.length) {
        const slow = upto > COARSE || this.here.has(lacks[0] as string);
        const drawn = lacks.some((name) => this.here.get(name)?.info.draft);
        const count = drawn ? 6 : slow ? Math.max(1, Math.floor(room / (RGBA * upto * upto))) : lacks.length;
        const names = lacks.slice(0, count);
        for (const name of names) this.asked.set(name, this.here.get(name)?.info.draft ? -1 : upto);
        return { names, upto: drawn ? 2 * COARSE : upto };
      }
      if (upto >= Math.min(side, this.largest)) return null;
    }
  }

  /** What was on its way may be lost. */
  again(): void {
    this.asked.clear();
  }

  /** Take what a message holds, tile after tile, size after size. */
  receive(tiles: TileInfo[], data: Uint8Array): void {
    let at = 0;
    for (const info of tiles) {
      const old = this.here.get(info.name);
      const renewed = !old || old.info.draft;
      const own: Tile = renewed ? { info, levels: info.sizes.map(() => undefined) } : old;
      for (let k = info.first; k < info.end; k += 1) {
        const [w, h] = info.sizes[k] as Pixels;
        own.levels[k] = data.slice(at, at + RGBA * w * h);
        at += RGBA * w * h;
      }
      this.here.set(info.name, own);
      if (renewed) this.version += 1;
    }
  }

  /** The side to show: as much as is needed and has come, within so many bytes and pixels a side. */
  sideFor(needed: number, bytes: number, most: number): number {
    let side = Math.min(this.complete, needed);
    for (; side > 1; side /= 2) {
      const { size } = shelved(this.shown(side).map(({ size: own }) => own));
      if (RGBA * size[0] * size[1] <= bytes && sideOf(size) <= most) break;
    }
    return Math.max(1, side);
  }

  private shown(side: number): { tile: number; level: number; size: Pixels }[] {
    return this.names.flatMap((name, tile) => {
      const own = this.here.get(name);
      if (!own) return [];
      const { sizes } = own.info;
      return sizes.flatMap((size, level) =>
        own.levels[level] && (sideOf(size) <= side || level === sizes.length - 1) ? [{ tile, level, size }] : [],
      );
    });
  }

  /** The image of all sizes up to a side, and the table of where each stands: what shaders read. */
  arranged(side: number): { atlas: Texture; tile_table: Texture } {
    const shown = this.shown(side);
    const {
      places,
      size: [wide, tall],
    } = shelved(shown.map(({ size }) => size));
    const content = new Uint8Array(RGBA * wide * tall);
    const boxes: number[][][] = this.names.map(() => []);
    shown.forEach(({ tile, level, size: [w, h] }, k) => {
      const [x, y] = places[k] as Pixels;
      const own = this.here.get(this.names[tile] as string)?.levels[level] as Uint8Array;
      for (let row = 0; row < h; row += 1)
        content.set(own.subarray(RGBA * w * row, RGBA * w * (row + 1)), RGBA * ((y + row) * wide + x));
      boxes[tile]?.push([x, y, w, h]);
    });
    const levels = Math.max(1, ...boxes.map((own) => own.length));
    const rows = Math.max(1, this.names.length);
    const table = new Float32Array(RGBA * (levels + 1) * rows);
    boxes.forEach((own, tile) => {
      const at = RGBA * (levels + 1) * tile;
      table[at] = Number(this.here.get(this.names[tile] as string)?.info.grey ?? true);
      for (let k = 0; k < levels; k += 1)
        table.set(own[Math.min(k, own.length - 1)] ?? [0, 0, 1, 1], at + RGBA * (k + 1));
    });
    if (!this.names.length) table.set([1, 0, 0, 0, 0, 0, 1, 1]);
    return {
      atlas: { image: { size: [wide, tall], channels: RGBA, kind: "f1" }, content },
      tile_table: {
        image: { size: [levels + 1, rows], channels: RGBA, kind: "f4" },
        content: new Uint8Array(table.buffer),
      },
    };
  }
}

/** The side of tiles whose texels are no larger than pixels, from a place with the mesh's boxes so far away at least. */
export function sideNeeded(place: Place, wide: number, low: ArrayLike<number>, high: ArrayLike<number>): number {
  let nearest = Infinity;
  for (let k = 0; k < low.length; k += 3) {
    let far = 0;
    for (let axis = 0; axis < 3; axis += 1) {
      const at = place[axis] as number;
      far += Math.max((low[k + axis] as number) - at, 0, at - (high[k + axis] as number)) ** 2;
    }
    nearest = Math.min(nearest, far);
  }
  const pixel = (2 * Math.sqrt(nearest) * Math.tan((place[5] * Math.PI) / 360)) / Math.max(wide, 1);
  const texels = (2 * EXTENT) / Math.max(pixel, 1e-3); // a size is sampled up to where two of its texels are a pixel
  return Math.max(COARSE, 2 ** Math.ceil(Math.log2(texels)));
}
