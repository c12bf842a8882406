// What the views of one texture model on a page share: the grammar unpacked, and what is typed but not yet answered.

import { type Bytes, byteLength, unpack } from "../solver/packing.ts";
import type { Fault, WidgetModel } from "../types.ts";
import { renderer } from "./renderer.ts";
import type { Common, Pair, Scene, Step, Tiles, Triple } from "./types.ts";

const sessions = new WeakMap<WidgetModel, Session>();

const PLAIN = ["text", "faults", "ack", "size", "seed", "hour", "lit", "point", "ray", "steps", "trouble"] as const;
const PACKED = ["scene", "tiles", "light"] as const;

export class Session {
  readonly client = Math.random().toString(36).slice(2);
  scene: Scene | null = null;
  tiles: Tiles | null = null;
  common: Common | null = null;
  /** The step of the derivation that is looked at. */
  step = 0;
  private seq = 0;
  private acknowledged = 0;
  private waiting: string | null = null;
  private unpacking = 0;
  private readonly views = new Set<() => void>();

  private constructor(private readonly channel: WidgetModel) {}

  static of(channel: WidgetModel): Session {
    let session = sessions.get(channel);
    if (!session) {
      session = new Session(channel);
      sessions.set(channel, session);
    }
    return session;
  }

  get live(): boolean {
    return this.channel.comm_live !== false;
  }
  get size(): Pair {
    return this.channel.get<Pair>("size");
  }
  get seed(): Pair {
    return this.channel.get<Pair>("seed");
  }
  get hour(): number {
    return this.channel.get<number>("hour");
  }
  get lit(): boolean {
    return this.channel.get<boolean>("lit");
  }
  get text(): string {
    return this.channel.get<string>("text");
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
  get trouble(): string {
    return this.channel.get<string>("trouble");
  }
  /** Whether a text is on its way: the field must not be written to. */
  get typing(): boolean {
    return this.waiting !== null || this.acknowledged < this.seq;
  }

  /** Hold the session for a view until the signal ends; `update` is called after every change. */
  hold(update: () => void, signal: AbortSignal): void {
    if (this.views.size === 0) this.begin();
    this.views.add(update);
    signal.addEventListener("abort", () => {
      this.views.delete(update);
      if (this.views.size === 0) this.end();
    });
    update();
  }

  /** Send what was typed: at once, or when the answer to the last text has come. */
  type(text: string): void {
    this.waiting = text;
    this.flush();
  }

  set(name: "size" | "seed" | "hour" | "lit", value: unknown): void {
    this.channel.set({ [name]: value });
    this.send({ op: "set", name, value });
  }

  pick(point: Pair | null, ray: Triple | null = null): void {
    this.send({ op: "pick", point, ray });
  }

  look(step: number): void {
    this.step = step;
    this.tell();
  }

  private flush(): void {
    if (this.waiting === null || this.acknowledged < this.seq || !this.live) return;
    this.seq += 1;
    this.send({ op: "text", text: this.waiting, client: this.client, seq: this.seq });
    this.waiting = null;
  }

  private send(message: Record<string, unknown>): void {
    if (this.live) this.channel.send(message);
  }

  private readonly onPlain = (): void => this.tell();
  private readonly onSteps = (): void => {
    this.step = Math.max(0, this.steps.length - 1);
    this.tell();
  };
  private readonly onAck = (): void => {
    const ack = this.channel.get<{ client?: string; seq?: number }>("ack");
    if (ack.client !== this.client) return;
    this.acknowledged = Math.max(this.acknowledged, ack.seq ?? 0);
    this.flush();
    this.tell();
  };
  private readonly onPacked = (): void => void this.unpack();

  private begin(): void {
    for (const name of PLAIN) this.channel.on(`change:${name}`, this.onPlain);
    for (const name of PACKED) this.channel.on(`change:${name}`, this.onPacked);
    this.channel.on("change:steps", this.onSteps);
    this.channel.on("change:ack", this.onAck);
    this.send({ op: "view", client: this.client, here: true });
    this.step = Math.max(0, this.steps.length - 1);
    void this.unpack();
  }

  private end(): void {
    for (const name of PLAIN) this.channel.off(`change:${name}`, this.onPlain);
    for (const name of PACKED) this.channel.off(`change:${name}`, this.onPacked);
    this.channel.off("change:steps", this.onSteps);
    this.channel.off("change:ack", this.onAck);
    for (const own of [this.scene, this.tiles]) if (own) renderer().release(own);
    this.scene = this.tiles = this.common = null;
    this.send({ op: "view", client: this.client, here: false });
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

  private tell(): void {
    for (const update of [...this.views]) update();
  }
}
