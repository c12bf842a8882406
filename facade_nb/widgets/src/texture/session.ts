// What the views of one texture model on a page share: the grammar unpacked, and what was entered but is not yet answered.

import { oneFor } from "../shared/one.ts";
import { Shared } from "../shared/shared.ts";
import type { Fault } from "../shared/types.ts";
import { type Bytes, byteLength, unpack } from "../solver/packing.ts";
import { renderer } from "./renderer.ts";
import type { Common, Pair, Scene, Step, Tiles, Triple } from "./types.ts";

const PLAIN = [
  "text",
  "faults",
  "size",
  "seed",
  "hour",
  "lit",
  "point",
  "ray",
  "still",
  "trouble",
  "can_undo",
  "can_redo",
] as const;
const PACKED = ["scene", "tiles", "light"] as const;

type Entered = "text" | "size" | "seed" | "hour" | "lit";

interface Queued {
  message: { op: string; value?: unknown; [argument: string]: unknown };
  /** What it sets; "": nothing, it asks for something. */
  name: Entered | "";
}

export class Session extends Shared {
  static readonly of = oneFor((channel) => new Session(channel));

  scene: Scene | null = null;
  tiles: Tiles | null = null;
  common: Common | null = null;
  /** The step of the derivation that is looked at. */
  step = 0;
  private seq = 0;
  /** What was entered and is not yet sent; what is sent and not yet answered. Views show these. */
  private queue: Queued[] = [];
  private flying: Queued | null = null;
  /** The operation that was sent last. */
  private last = "";
  private unpacking = 0;

  get size(): Pair {
    return this.value<Pair>("size");
  }
  get seed(): Pair {
    return this.value<Pair>("seed");
  }
  get hour(): number {
    return this.value<number>("hour");
  }
  get lit(): boolean {
    return this.value<boolean>("lit");
  }
  get text(): string {
    return this.value<string>("text");
  }
  get faults(): Fault[] {
    return this.channel.get<Fault[]>("faults");
  }
  get steps(): Step[] {
    return this.channel.get<Step[]>("steps");
  }
  get point(): Pair | null {
    const point = this.channel.get<number[]>("point");
    return point.length === 2 ? (point as Pair) : null;
  }
  /** A picture in PNG, where one was drawn for pages that cannot draw. */
  get still(): Uint8Array<ArrayBuffer> | null {
    const bytes = this.channel.get<Bytes>("still");
    if (!byteLength(bytes)) return null;
    return bytes instanceof ArrayBuffer
      ? new Uint8Array(bytes)
      : new Uint8Array(bytes.buffer as ArrayBuffer, bytes.byteOffset, bytes.byteLength);
  }
  get canUndo(): boolean {
    return this.channel.get<boolean>("can_undo") || this.queue.length > 0 || this.flying !== null;
  }
  get canRedo(): boolean {
    return this.channel.get<boolean>("can_redo");
  }
  /** Whether a text is on its way. */
  get typing(): boolean {
    return this.own("text") !== undefined;
  }
  /** Whether what changes now does so because it is undone or redone. */
  get undoing(): boolean {
    return this.last === "undo" || this.last === "redo";
  }

  /** Whether something was entered that Python has not answered. */
  get waits(): boolean {
    return this.entered().length > 0;
  }

  override hold(update: () => void, signal: AbortSignal): void {
    super.hold(update, signal);
    update();
  }

  /** Take a value: it is shown at once, and sent at once or when the answer to what was sent before has come. */
  set(name: Entered, value: unknown): void {
    if (this.kernel.presence === "saved") this.channel.set(name, value);
    else {
      const message = { op: "set", name, value };
      // What was asked for in between is about the value before it.
      const since = this.queue.findLastIndex((queued) => queued.name === "");
      const waiting = this.queue.find((queued, i) => i > since && queued.name === name);
      if (waiting) waiting.message = message;
      else this.queue.push({ message, name });
      this.flush();
    }
    this.tell();
  }

  /** Go one step back or forward; kept in order with what is entered. */
  ask(op: "undo" | "redo"): void {
    if (!this.live) return;
    this.queue.push({ message: { op }, name: "" });
    this.flush();
    this.tell();
  }

  pick(point: Pair | null, ray: Triple | null = null): void {
    this.kernel.tell({ op: "pick", point, ray });
  }

  /** Have Python draw a still picture, now and after every change. */
  askStill(): void {
    this.kernel.tell({ op: "still" });
  }

  look(step: number): void {
    this.step = step;
    this.tell();
  }

  private value<T>(name: Entered): T {
    const own = this.own(name);
    return own ? (own.message.value as T) : this.channel.get<T>(name);
  }

  /** The last message on its way that sets this. */
  private own(name: Entered): Queued | undefined {
    const set = (queued: Queued) => queued.name === name;
    return this.queue.findLast(set) ?? (this.flying && set(this.flying) ? this.flying : undefined);
  }

  /** One message is on its way at a time; of several for one name only the last is sent. */
  private flush(): void {
    if (this.flying || !this.live) return;
    const next = this.queue.shift();
    if (!next) return;
    this.flying = next;
    this.last = next.message.op;
    this.seq += 1;
    this.submit();
  }

  /** Send what is on its way. */
  private submit(): void {
    if (this.flying) this.kernel.tell({ ...this.flying.message, client: this.client, seq: this.seq });
  }

  /** What sets something and has no answer, in the order in which it was entered. */
  private entered(): Queued[] {
    return [...(this.flying ? [this.flying] : []), ...this.queue].filter(({ name }) => name !== "");
  }

  /** After a gap what was on its way is sent again, if it was lost; when the kernel has gone, what was entered is kept. */
  protected override kernelChanged(): void {
    if (this.live && this.flying) {
      if (this.kernel.received(this.client) < this.seq) this.submit();
      else this.flying = null;
    }
    this.flush();
    if (this.kernel.presence === "gone")
      for (const { name, message } of this.entered()) this.channel.set(name, message.value);
    super.kernelChanged();
  }

  private readonly onSteps = (): void => {
    this.step = Math.max(0, this.steps.length - 1);
    this.tell();
  };
  private readonly onAck = (): void => {
    const ack = this.channel.get<{ client?: string; seq?: number }>("ack");
    if (ack.client !== this.client) return;
    if ((ack.seq ?? 0) < this.seq) return;
    this.flying = null;
    this.flush();
    this.tell();
  };

  protected begin(): void {
    for (const name of PLAIN) this.listen(name, () => this.tell());
    for (const name of PACKED) this.listen(name, () => void this.unpack());
    this.listen("steps", this.onSteps);
    this.listen("ack", this.onAck);
    this.step = Math.max(0, this.steps.length - 1);
    void this.unpack();
  }

  protected end(): void {
    for (const own of [this.scene, this.tiles]) if (own) renderer().release(own);
    this.scene = this.tiles = this.common = null;
    if (this.kernel.presence === "gone") return; // a view that is made later shows what was entered, and says so
    this.flying = null;
    this.queue = [];
  }

  /** Scene and tiles belong together: they are taken over at once, when both are unpacked. */
  private async unpack(): Promise<void> {
    this.unpacking += 1;
    const turn = this.unpacking;
    await Promise.resolve(); // the other trait of the same message
    const [scene, tiles, common] = await Promise.all([
      this.piece<Scene>("scene"),
      this.piece<Tiles>("tiles"),
      this.piece<Common>("light"),
    ]);
    if (turn !== this.unpacking || this.views.size === 0 || !scene || !tiles || !common) return;
    for (const [old, now] of [
      [this.scene, scene],
      [this.tiles, tiles],
    ] as const)
      if (old && old !== now) renderer().release(old);
    this.scene = scene;
    this.tiles = tiles;
    this.common = common;
    this.tell();
  }

  private readonly unpacked = new Map<string, { bytes: Bytes; value: Promise<unknown> }>();

  private async piece<T>(name: string): Promise<T | null> {
    const bytes = this.channel.get<Bytes>(name);
    if (!byteLength(bytes)) return null;
    let found = this.unpacked.get(name);
    if (found?.bytes !== bytes) {
      found = { bytes, value: unpack<T>(bytes) };
      this.unpacked.set(name, found);
    }
    return found.value as Promise<T>;
  }
}
