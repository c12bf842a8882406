// What the 3D views of one design on a page share: its mesh and what draws it, unpacked, and the tiles as far as they have come.

import { oneFor } from "../shared/one.ts";
import { type Bytes, byteLength, inflated, unpack } from "../shared/packing.ts";
import { Shared } from "../shared/shared.ts";
import type { WidgetModel } from "../shared/types.ts";
import { type TileReply, Tiles } from "../town/tiles.ts";
import type { Mesh, Packed, Works } from "./types.ts";

const PACKED = ["works", "mesh"] as const;
const ROOM = 1 << 20; // bytes of tiles that a message holds

export class BuildingData extends Shared {
  static readonly of = oneFor((channel) => new BuildingData(channel));

  works: Works | null = null;
  mesh: Mesh | null = null;
  readonly tiles = new Tiles();
  private readonly taken = new Map<string, { bytes: Bytes; value: Promise<unknown> }>();
  private turn = 0;
  private line: Promise<void> = Promise.resolve();
  private wanted = 0;
  private waits = false;

  private constructor(channel: WidgetModel) {
    super(channel);
    saveNothing(channel);
  }

  override hold(update: () => void, signal: AbortSignal): void {
    super.hold(update, signal);
    update();
  }

  /** Whether no tiles are on their way. */
  get settled(): boolean {
    return !this.waits;
  }

  /** Have tiles with sides up to so many pixels, as soon as they come. */
  want(side: number): void {
    this.wanted = Math.max(this.wanted, side);
    this.ask();
  }

  protected begin(): void {
    for (const name of PACKED) this.listen(name, () => void this.take());
    const heard = (message: TileReply, buffers: Bytes[]) => {
      if (message.kind === "tiles" && message.client === this.client && buffers[0]) this.receive(message, buffers[0]);
    };
    this.channel.on("msg:custom", heard);
    this.present.signal.addEventListener("abort", () => this.channel.off("msg:custom", heard));
    void this.take();
  }

  protected end(): void {
    this.works = this.mesh = null;
    this.taken.clear();
    this.wanted = 0;
  }

  protected override kernelChanged(): void {
    if (this.live) {
      this.tiles.again();
      this.waits = false;
      this.ask();
    }
    super.kernelChanged();
  }

  /** Mesh and works belong together: they are taken over at once. */
  private async take(): Promise<void> {
    this.turn += 1;
    const { turn } = this;
    await Promise.resolve(); // the other trait of the same message
    const [works, packed] = await Promise.all([this.piece<Works>("works"), this.piece<Packed>("mesh")]);
    if (turn !== this.turn || this.views.size === 0) return;
    if (!works || !packed) {
      this.works = this.mesh = null;
      this.taken.clear();
      return;
    }
    if (works !== this.works) {
      this.tiles.take(works.tiles);
      if (this.tiles.lacking(works.tiles).length) this.tiles.receive(works.told, works.coarse);
    }
    this.works = works;
    this.mesh = meshOf(packed, works);
    this.ask();
    this.tell();
  }

  private piece<T>(name: string): Promise<T | null> {
    const bytes = this.channel.get<Bytes>(name);
    if (!byteLength(bytes)) return Promise.resolve(null);
    let found = this.taken.get(name);
    if (found?.bytes !== bytes) {
      found = { bytes, value: unpack<T>(bytes) };
      this.taken.set(name, found);
    }
    return found.value as Promise<T>;
  }

  private ask(): void {
    if (!this.works || this.waits || !this.live) return;
    const next = this.tiles.next(this.wanted, ROOM);
    if (!next) return;
    this.waits = true;
    const above = next.names.map((name) => this.tiles.above(name));
    this.kernel.tell({ op: "tiles", ...next, above, client: this.client });
  }

  private receive(message: TileReply, bytes: Bytes): void {
    this.line = this.line.then(async () => {
      this.tiles.receive(message.tiles, new Uint8Array(await inflated(bytes)));
      this.waits = false;
      this.ask();
      this.tell();
    });
  }
}

/** Vertices as the pipeline reads them, and corners for whoever looks for what a pixel shows. */
export function meshOf(packed: Packed, { stride }: Pick<Works, "stride">): Mesh {
  const { varying, facets, facet, indices, ...rest } = packed;
  const [floats, count] = [stride / 4, facet.length];
  const own = varying.length / Math.max(count, 1);
  const other = floats - own;
  const vertices = new Float32Array(floats * count);
  for (let k = 0; k < count; k += 1) {
    vertices.set(varying.subarray(own * k, own * (k + 1)), floats * k);
    const at = other * (facet[k] as number);
    vertices.set(facets.subarray(at, at + other), floats * k + own);
  }
  const corners = new Float32Array(3 * indices.length);
  for (let k = 0; k < indices.length; k += 1) {
    const at = own * (indices[k] as number);
    for (let axis = 0; axis < 3; axis += 1) corners[3 * k + axis] = varying[at + axis] as number;
  }
  return {
    ...rest,
    vertices: new Uint8Array(vertices.buffer),
    indices: new Uint8Array(indices.slice().buffer),
    corners,
  };
}

/** A notebook is saved with the last picture, not with what draws it. */
function saveNothing(channel: WidgetModel): void {
  const before = channel.serialize;
  channel.serialize = (state) => {
    const left = { ...state };
    for (const name of PACKED) if (name in left) left[name] = new DataView(new ArrayBuffer(0));
    return before ? before.call(channel, left) : left;
  };
}
