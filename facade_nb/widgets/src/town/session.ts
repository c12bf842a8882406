// What the views of one town on a page share: the town as far as it has come, where one stands, what is entered.

import { context } from "../pipeline/context.ts";
import { Pipeline, type Source } from "../pipeline/pipeline.ts";
import { h } from "../shared/dom.ts";
import { Entering } from "../shared/entering.ts";
import { noiseBytes } from "../shared/noise.ts";
import { oneFor } from "../shared/one.ts";
import { type Bytes, byteLength, bytesOf, unpack } from "../shared/packing.ts";
import type { Fault } from "../shared/types.ts";
import { CHOSEN, MARKED, SHADER } from "./chosen.ts";
import { Detail } from "./detail.ts";
import { Fitted } from "./fitted.ts";
import { cropped, daylight, frustumOf, isDay, type Sunlight, uniformsOf, visible } from "./frame.ts";
import { type Kept, Loading, type Reply } from "./loading.ts";
import { COARSE, sideNeeded, type TileReply } from "./tiles.ts";
import type { Head, Light, Pass, Pixels, Place, Stop, Values, Vector } from "./types.ts";
import { Walls } from "./walls.ts";

const PLAIN = ["section", "text", "faults", "restyled", "still", "trouble", "can_undo", "can_redo"] as const;
const SETTLED = 300; // milliseconds after which Python is told where one stands

type Entered = "text" | "section" | "hour" | "chosen" | "restyled" | "viewpoint" | "path";

type Message = Reply | TileReply | { kind: "patch"; name: string; at: number };

export interface Picked {
  building: number;
  point: Vector;
  rule: number[];
}

export class Session extends Entering<Entered> {
  static readonly of = oneFor((channel) => new Session(channel));

  head: Head | null = null;
  pipeline: Pipeline | null = null;
  walls: Walls | null = null;
  /** Where one stands; Python is told when one has come to rest. */
  place: Place = [0, 2, 0, 0, 0, 60];
  readonly loading = new Loading(
    (message) => this.kernel.tell({ ...message, client: this.client }),
    (name, at, end) => this.come(name, at, end),
    (chunk) => this.sort(chunk),
  );
  private readonly detail = new Detail();
  /** Counts what has changed in what is drawn, beside the place and the hour. */
  touched = 0;
  /** Counts sets of tiles: the same in another resolution. */
  finer = 0;
  /** Pixels of the widest view of it, which tell how fine tiles have to be. */
  wide = 720;
  private readonly fitted = new Fitted();
  /** The head that was read last. */
  private taken: Bytes | null = null;
  /** A head that waits for tiles that it names. */
  private waiting: Head | null = null;
  /** How many messages are being read. */
  private taking = 0;
  private line: Promise<void> = Promise.resolve();
  private telling = 0;
  private readonly movers = new Set<() => void>();

  get hour(): number {
    return this.value<number>("hour");
  }
  get light(): Light {
    return daylight((this.head as Head).hours, this.hour);
  }
  get chosen(): number {
    return this.value<number>("chosen");
  }
  get section(): string {
    return this.value<string>("section");
  }
  get text(): string {
    return this.value<string>("text");
  }
  get faults(): Fault[] {
    return this.channel.get<Fault[]>("faults");
  }
  get report(): string {
    return this.head?.report ?? "";
  }
  get typing(): boolean {
    return this.coming("text");
  }
  get path(): Stop[] {
    return this.value<Stop[]>("path");
  }
  get still(): Uint8Array<ArrayBuffer> | null {
    const bytes = this.channel.get<Bytes>("still");
    return byteLength(bytes) ? bytesOf(bytes) : null;
  }
  /** Number of a building's style. */
  styleOf(building: number): number {
    const own = this.channel.get<[number, number][]>("restyled").find(([number]) => number === building);
    return own?.[1] ?? this.head?.town?.style[building] ?? 0;
  }

  /** Say to all views that something has changed. */
  override tell(): void {
    super.tell();
  }

  override hold(update: () => void, signal: AbortSignal): void {
    super.hold(update, signal);
    update();
  }

  /** Be told when one has moved, until the signal ends. */
  onMove(moved: () => void, signal: AbortSignal): void {
    this.movers.add(moved);
    signal.addEventListener("abort", () => this.movers.delete(moved));
  }

  /** Stand somewhere else. */
  move(place: Place): void {
    if (place.every((value, k) => value === this.place[k])) return;
    this.place = place;
    this.arrange(true);
    this.loading.ask(place);
    for (const moved of [...this.movers]) moved();
    clearTimeout(this.telling);
    this.telling = window.setTimeout(() => this.set("viewpoint", [...this.place]), SETTLED);
  }

  /** Have Python draw a still picture, now and after every change. */
  askStill(): void {
    this.kernel.tell({ op: "still" });
  }

  /** Whether there is something to draw. */
  get drawable(): boolean {
    return !!this.pipeline && this.loading.meshed && !!this.fitted.images;
  }

  /** Whether all has come that there is to draw, as far as is known here. */
  get settled(): boolean {
    const { tiles, part } = this.loading;
    return part >= 1 && this.taking === 0 && !this.waiting && this.fitted.of(tiles);
  }

  /** The passes that run: not those that are switched off, nor those for which there is no cause now. */
  passes(off: readonly string[] = []): Pass[] {
    if (!this.head) return [];
    const sun = isDay(this.light);
    const lamps = (this.light.lamps as number[]).some((value) => value > 0);
    const written = new Set<string>();
    return (this.pipeline?.passes ?? []).filter(({ name, when, reads, writes }) => {
      if (off.includes(name) || (when === "shadow" && !sun) || (when === "lamps" && !lamps)) return false;
      if (when === "chosen" && (this.chosen < 0 || !reads.every((own) => written.has(own)))) return false;
      for (const own of writes) written.add(own);
      return true;
    });
  }

  /** Values of all shaders for a picture of so many pixels, or for a part of it. */
  values(pixels: Pixels, off: readonly string[] = [], part?: [number, number, number, number], sun?: Sunlight): Values {
    const head = this.head as Head;
    const whole = frustumOf(this.place, pixels);
    const on = (cause: string) => head.passes.every(({ name, when }) => when !== cause || !off.includes(name));
    const looks = { shadow: on("shadow"), occlusion: on("occlusion") };
    const frustum = part ? cropped(whole, ...part) : whole;
    const seed = head.town && this.chosen >= 0 ? seedOf(head.town.seed, this.chosen) : [-1, -1];
    return { ...uniformsOf(head, frustum, this.light, part ? [1, 1] : pixels, looks, sun), chosen_seed: seed };
  }

  /** Runs of indices that may be seen through a matrix, of what has come; `pixels`: without what is too small in those. */
  runs(through: Float64Array, pixels?: Pixels): Pixels[] {
    const { head, detail, place } = this;
    if (!head) return [];
    const { chunks } = head;
    const some = pixels ? (chunk: number) => detail.count(chunk, chunks, place, pixels) : undefined;
    return visible(chunks, through, (chunk) => this.loading.has(chunk), some);
  }

  /** All that a chunk draws is here: it is ordered, so that the smallest can be left out. */
  private sort(chunk: number): void {
    const { head, loading, detail } = this;
    if (!head) return;
    const [from, to] = detail.take(chunk, head, loading.content("vertices"), loading.content("indices"));
    this.pipeline?.changed("indices", from, to);
  }

  /** What stands at a place of the picture (0 to 1 from its lower left): drawn anew, for that one pixel. */
  pick(pixels: Pixels, across: number, up: number): Picked | null {
    const { pipeline, head } = this;
    const pass = pipeline?.passes.find(({ writes }) => writes.includes("rule"));
    if (!pipeline || !head?.town || !pass || !this.drawable) return null;
    const [x, y] = [Math.floor(across * pixels[0]), Math.floor(up * pixels[1])];
    const [w, h] = pixels;
    const values = this.values(pixels, [], [x / w, y / h, (x + 1) / w, (y + 1) / h]);
    pipeline.run(pass, values, [1, 1], { runs: this.runs(values[pass.through] as Float64Array) });
    const [rule, facing] = ["rule", "facing"].map((name) => pipeline.values(name, [1, 1], [1, 1]));
    const depth = facing?.[3] ?? 0;
    if (!rule || depth <= 0) return null;
    const building = buildingOf(head.town.seed, rule[2] as number, rule[3] as number);
    const [left, bottom, dx, dy] = values.window as number[] as [number, number, number, number];
    const at = (k: number) =>
      (this.place[k] as number) +
      depth *
        ((left + 0.5 * dx) * ((values.across as Vector)[k] as number) +
          (bottom + 0.5 * dy) * ((values.upward as Vector)[k] as number) +
          ((values.forward as Vector)[k] as number));
    return { building, point: [at(0), at(1), at(2)], rule: [...rule] };
  }

  private source(head: Head): Source {
    const textures: Source["textures"] = Object.fromEntries(
      Object.entries(head.textures).map(([name, image]) => [
        name,
        { image, content: name === "grammar" ? head.grammar : noiseBytes() },
      ]),
    );
    return {
      passes: [...head.passes, ...(head.town ? [CHOSEN] : [])],
      buffers: [...head.buffers, MARKED],
      shaders: { ...head.shaders, "chosen:vertex": head.shaders["tone:vertex"] ?? "", "chosen:fragment": SHADER },
      stride: head.stride,
      attributes: head.attributes,
      vertices: this.loading.content("vertices"),
      indices: this.loading.content("indices"),
      turning: head.turning,
      textures: { ...textures, ...this.fitted.images },
    };
  }

  /** Give the card finer tiles where the view needs them and they have come; `moving`: one size up at a time. */
  arrange(moving = false): boolean {
    const { head, pipeline, loading, fitted } = this;
    if (!head || !pipeline) return false;
    loading.needed = sideNeeded(this.place, this.wide, head.chunks.low, head.chunks.high);
    const bounds = { bytes: head.tile_bytes, most: context().largest };
    if (!fitted.fit(loading.tiles, loading.needed, bounds, moving)) return false;
    pipeline.replace(this.source(head));
    this.finer += 1;
    return true;
  }

  /** A block of something large has come. */
  private come(name: string, at: number, end: number): void {
    this.pipeline?.changed(name, at, end);
    if (name === "edges" && this.loading.whole("edges")) {
      const bytes = this.loading.content("edges");
      this.walls = new Walls(new Float32Array(bytes.buffer as ArrayBuffer, 0, bytes.length / 4));
    }
  }

  protected override begin(): void {
    super.begin();
    for (const name of PLAIN) this.listen(name, () => this.tell());
    for (const name of ["hour", "chosen", "path"]) this.listen(name, () => this.tell());
    this.listen("head", () => this.inTurn(() => this.take()));
    this.listen("viewpoint", () => this.follow());
    const heard = (message: Message, buffers: Bytes[]) => this.inTurn(() => this.receive(message, buffers));
    this.channel.on("msg:custom", heard);
    this.present.signal.addEventListener("abort", () => this.channel.off("msg:custom", heard));
    this.hidePicture();
    this.follow(true);
    this.inTurn(async () => {
      await this.take();
      const kept = this.live ? undefined : this.channel.get<Bytes>("kept");
      if (this.head && byteLength(kept)) this.loading.fill(await unpack<Kept>(kept as Bytes));
      if (this.head) this.loading.ask(this.place);
      this.arrange();
      this.tell();
    });
  }

  protected override end(): void {
    clearTimeout(this.telling);
    this.pipeline?.free();
    super.end();
  }

  /** The picture that the notebook carries in an output of its own (`following.py`) is not seen beside the views. */
  private hidePicture(): void {
    const output = `.fnb-follows-${this.channel.model_id}`;
    const style = h("style", {}, `${output}, .jp-OutputArea-child:has(${output}) { display: none }`);
    document.head.append(style);
    this.present.signal.addEventListener("abort", () => style.remove());
  }

  protected override kernelChanged(): void {
    super.kernelChanged();
    if (!this.live || !this.head) return;
    this.loading.again(this.place);
    if (this.waiting) this.loading.demand(this.loading.tiles.lacking(this.waiting.tiles), COARSE);
  }

  /** Python has said where one is to stand. */
  private follow(first = false): void {
    const told = this.channel.get<number[]>("viewpoint");
    if (told.length !== 6 || this.coming("viewpoint")) return;
    if (!first && told.every((value, k) => Math.abs(value - (this.place[k] as number)) < 1e-9)) return;
    clearTimeout(this.telling);
    this.place = told as Place;
    this.arrange();
    this.loading.ask(this.place);
    for (const moved of [...this.movers]) moved();
  }

  /** Heads and blocks are taken in the order in which they were sent. */
  private inTurn(act: () => Promise<void>): void {
    this.taking += 1;
    this.tell();
    this.line = this.line
      .then(act)
      .catch((error) => console.error(error))
      .then(() => {
        this.taking -= 1;
        this.tell();
      });
  }

  /** Read the head and compile shaders before there is a view. */
  prepare(): void {
    if (!this.head) this.inTurn(() => this.take());
  }

  private async take(): Promise<void> {
    const bytes = this.channel.get<Bytes>("head");
    if (!byteLength(bytes) || bytes === this.taken) return;
    this.taken = bytes;
    const head = await unpack<Head>(bytes);
    const lacks = this.loading.tiles.lacking(head.tiles);
    if (this.head && lacks.length && this.live) {
      this.waiting = head; // what is shown stays until it can be replaced as a whole
      this.loading.demand(lacks, COARSE);
      return;
    }
    this.enter(head);
  }

  private enter(head: Head): void {
    this.waiting = null;
    const old = this.head;
    this.loading.take(head);
    if (old && head.starts.length === old.starts.length) this.renumber(old.starts, head.starts);
    this.head = head;
    const source = this.source(head);
    if (this.pipeline) this.pipeline.replace(source);
    else this.pipeline = new Pipeline(source);
    this.arrange();
    if (!context().whyNot) this.pipeline.ready(); // shaders are compiled while the mesh is on its way
    if (this.views.size > 0) this.loading.ask(this.place);
    this.touched += 1;
    this.tell();
  }

  private async receive(message: Message, buffers: Bytes[]): Promise<void> {
    if (message.kind === "blocks") {
      if (message.client !== this.client) return;
      await this.loading.receive(message, buffers);
      this.loading.ask(this.place);
    } else if (message.kind === "tiles" && buffers[0]) {
      if (message.client !== this.client) return;
      await this.loading.receiveTiles(message, buffers[0]);
      const next = this.waiting;
      if (next && !this.loading.tiles.lacking(next.tiles).length) this.enter(next);
      else this.arrange();
      this.loading.ask(this.place);
    } else if (message.kind === "patch" && buffers[0]) {
      const bytes = bytesOf(buffers[0]);
      this.loading.content(message.name).set(bytes, message.at);
      this.pipeline?.changed(message.name, message.at, message.at + bytes.length);
      this.touched += 1;
    } else return;
    this.tell();
  }

  /** The rules that walls begin with have moved in the grammar's texture: so do the vertices that name them. */
  private renumber(old: number[], now: number[]): void {
    if (old.every((value, k) => value === now[k])) return;
    const head = this.head as Head;
    const bytes = this.loading.content("vertices");
    const [stride, offset] = [head.stride / 4, (head.attributes.start?.[1] ?? 0) / 4];
    const all = new Float32Array(bytes.buffer as ArrayBuffer, 0, bytes.length / 4);
    const moved = new Map<number, [number, number]>();
    for (let k = 0; k < old.length; k += 2)
      moved.set((old[k + 1] as number) * 65536 + (old[k] as number), [now[k] as number, now[k + 1] as number]);
    for (let at = offset; at < all.length; at += stride) {
      const to = moved.get((all[at + 1] as number) * 65536 + (all[at] as number));
      if (to) [all[at], all[at + 1]] = to;
    }
    this.pipeline?.changed("vertices");
  }
}

/** A building's seed as shaders have it, metres. */
export function seedOf(seeds: Int32Array, building: number): [number, number] {
  return [(seeds[2 * building] as number) / 64, (seeds[2 * building + 1] as number) / 64];
}

/** The building with a seed; -1: none. */
export function buildingOf(seeds: Int32Array, x: number, y: number): number {
  const [a, b] = [Math.round(x * 64), Math.round(y * 64)];
  for (let k = 0; k < seeds.length; k += 2) if (seeds[k] === a && seeds[k + 1] === b) return k / 2;
  return -1;
}
