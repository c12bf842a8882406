// What is large comes in blocks, as it is asked for: what lies near first. Each is kept here too, for the day when the
// context is lost or the kernel is gone.

import { type Bytes, inflated } from "../shared/packing.ts";
import { COARSE, type TileInfo, type TileReply, Tiles } from "./tiles.ts";
import type { BlobInfo, Chunks, Head, Place } from "./types.ts";

const AT_ONCE = 4_000_000; // bytes that one message asks for, about, before they are deflated
const UNDER_WAY = 2; // messages
const NEAR = 260; // metres within which the mesh comes before all that is not needed at once

export interface Reply {
  kind: "blocks";
  name: string;
  version: number;
  blocks: number[];
  client: string;
}

/** What a saved state has in place of blocks. */
export interface Kept {
  blobs: Record<string, Uint8Array>;
  tiles: TileInfo[];
  pixels: Uint8Array;
}

export class Loading {
  private readonly blobs = new Map<
    string,
    { info: BlobInfo; content: Uint8Array; have: Set<number>; asked: Set<number> }
  >();
  private flying = 0;
  private chunks: Chunks | null = null;
  private readonly ready = new Set<number>();
  readonly tiles = new Tiles();
  /** The side of tiles that the view needs now. */
  needed = COARSE;

  constructor(
    private readonly send: (message: Record<string, unknown>) => void,
    /** Bytes from here to there have come. */
    private readonly come: (name: string, at: number, end: number) => void,
    /** All that a chunk draws is here. */
    private readonly ripe: (chunk: number) => void = () => {},
  ) {}

  /** Take a head: what it has in another version is forgotten. */
  take(head: Head): void {
    this.chunks = head.chunks;
    this.tiles.take(head.tiles);
    for (const [name, info] of Object.entries(head.blobs)) {
      const old = this.blobs.get(name);
      if (old && old.info.version === info.version && old.info.bytes === info.bytes) continue;
      this.blobs.set(name, { info, content: new Uint8Array(info.bytes), have: new Set(), asked: new Set() });
    }
  }

  content(name: string): Uint8Array {
    return this.blobs.get(name)?.content ?? new Uint8Array();
  }

  whole(name: string): boolean {
    const own = this.blobs.get(name);
    return !!own && own.have.size === countOf(own.info);
  }

  /** The part of all bytes that is here. */
  get part(): number {
    let [here, all] = this.tiles.bytes;
    for (const { info, have } of this.blobs.values()) {
      all += info.bytes;
      here += Math.min(info.bytes, have.size * info.block);
    }
    return all ? here / all : 0;
  }

  /** Whether all that a chunk draws is here. */
  has(chunk: number): boolean {
    if (this.ready.has(chunk)) return true;
    const [vertices, indices, chunks] = [this.blobs.get("vertices"), this.blobs.get("indices"), this.chunks];
    if (!vertices || !indices || !chunks) return false;
    for (const block of vertexBlocks(chunks, chunk)) if (!vertices.have.has(block)) return false;
    for (const block of indexBlocks(chunks, chunk, indices.info)) if (!indices.have.has(block)) return false;
    this.ready.add(chunk);
    this.ripe(chunk);
    return true;
  }

  get meshed(): boolean {
    return this.ready.size > 0;
  }

  /** Ask for what is needed next, standing there. */
  ask(place: Place): void {
    while (this.flying < UNDER_WAY) {
      const next = this.next(place);
      if (!next) return;
      if ("upto" in next) {
        this.demand(next.names, next.upto);
        continue;
      }
      const own = this.blobs.get(next.name);
      if (!own) return;
      for (const block of next.blocks) own.asked.add(block);
      this.flying += 1;
      this.send({ op: "blocks", name: next.name, version: own.info.version, blocks: next.blocks });
    }
  }

  /** Ask for tiles. */
  demand(names: string[], upto: number): void {
    this.flying += 1;
    this.send({ op: "tiles", names, above: names.map((name) => this.tiles.above(name)), upto });
  }

  /** After a gap in the connection: what was on its way may be lost. */
  again(place: Place): void {
    for (const { asked, have } of this.blobs.values()) {
      asked.clear();
      for (const block of have) asked.add(block);
    }
    this.tiles.again();
    this.flying = 0;
    this.ask(place);
  }

  /** Take the blocks of a message. */
  async receive({ name, version, blocks }: Reply, buffers: Bytes[]): Promise<void> {
    this.flying = Math.max(0, this.flying - 1);
    const whole = (await Promise.all(buffers.map(inflated))).map((data) => new Uint8Array(data));
    const own = this.blobs.get(name);
    if (own?.info.version !== version) return;
    blocks.forEach((block, k) => {
      const bytes = whole[k];
      if (!bytes) return;
      own.content.set(bytes, block * own.info.block);
      own.have.add(block);
      this.come(name, block * own.info.block, block * own.info.block + bytes.length);
    });
    if (name === "vertices" || name === "indices") for (const c of this.chunks?.first.keys() ?? []) this.has(c);
  }

  /** Take the tiles of a message. */
  async receiveTiles({ tiles }: TileReply, buffer: Bytes): Promise<void> {
    this.flying = Math.max(0, this.flying - 1);
    this.tiles.receive(tiles, new Uint8Array(await inflated(buffer)));
  }

  /** Take all at once, where there is no kernel to ask. */
  fill({ blobs, tiles, pixels }: Kept): void {
    this.tiles.receive(tiles, pixels);
    for (const [name, content] of Object.entries(blobs)) {
      const own = this.blobs.get(name);
      if (own?.content.length !== content.length) continue;
      own.content.set(content);
      for (let block = 0; block < countOf(own.info); block += 1) own.have.add(block);
      this.come(name, 0, content.length);
    }
    for (const chunk of this.chunks?.first.keys() ?? []) this.has(chunk);
  }

  private next(place: Place): { name: string; blocks: number[] } | { names: string[]; upto: number } | null {
    return (
      (this.tiles.complete ? null : this.tiles.next(COARSE, AT_ONCE)) ??
      this.near(place, this.meshed ? NEAR : 0) ??
      this.tiles.next(this.needed, AT_ONCE) ??
      this.of("edges") ??
      this.near(place, Infinity) ??
      this.tiles.next(Infinity, AT_ONCE)
    );
  }

  /** The next blocks of something. */
  private of(name: string): { name: string; blocks: number[] } | null {
    const own = this.blobs.get(name);
    if (!own) return null;
    const blocks: number[] = [];
    for (let k = 0; k < countOf(own.info) && blocks.length * own.info.block < AT_ONCE; k += 1)
      if (!own.asked.has(k)) blocks.push(k);
    return blocks.length ? { name, blocks } : null;
  }

  /** Blocks of the mesh for the nearest chunks that lack some, within so many metres; the nearest chunk at any rate. */
  private near([x, , z]: Place, within: number): { name: string; blocks: number[] } | null {
    const [vertices, indices, chunks] = [this.blobs.get("vertices"), this.blobs.get("indices"), this.chunks];
    if (!vertices || !indices || !chunks) return null;
    const away = (c: number) => {
      const dx = Math.max((chunks.low[3 * c] as number) - x, 0, x - (chunks.high[3 * c] as number));
      const dz = Math.max((chunks.low[3 * c + 2] as number) - z, 0, z - (chunks.high[3 * c + 2] as number));
      return Math.hypot(dx, dz);
    };
    const order = Array.from(chunks.first.keys())
      .filter((c) => !this.ready.has(c))
      .map((c) => [away(c), c] as const)
      .sort((a, b) => a[0] - b[0]);
    const wanted = { vertices: new Set<number>(), indices: new Set<number>() };
    for (const [far, c] of order) {
      if (far > within && wanted.vertices.size + wanted.indices.size > 0) break;
      if (far > within && this.meshed) break;
      for (const block of vertexBlocks(chunks, c)) if (!vertices.asked.has(block)) wanted.vertices.add(block);
      for (const block of indexBlocks(chunks, c, indices.info))
        if (!indices.asked.has(block)) wanted.indices.add(block);
      if (wanted.vertices.size * vertices.info.block > AT_ONCE) break;
    }
    if (wanted.indices.size) return { name: "indices", blocks: [...wanted.indices] };
    return wanted.vertices.size ? { name: "vertices", blocks: [...wanted.vertices] } : null;
  }
}

const countOf = (info: BlobInfo): number => (info.block ? Math.ceil(info.bytes / info.block) : 0);

function vertexBlocks({ needs, blocks }: Chunks, chunk: number): Int32Array {
  return blocks.subarray(needs[chunk], needs[chunk + 1]);
}

function* indexBlocks({ first, count }: Chunks, chunk: number, { block }: BlobInfo): Generator<number> {
  const begin = 4 * (first[chunk] as number);
  const end = begin + 4 * (count[chunk] as number);
  for (let k = Math.floor(begin / block); k * block < end; k += 1) yield k;
}
