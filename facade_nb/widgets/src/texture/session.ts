// What the views of one texture model on a page share: the grammar unpacked, and what was entered but is not yet answered.

import { Entering } from "../shared/entering.ts";
import { oneFor } from "../shared/one.ts";
import { type Bytes, byteLength, bytesOf, unpack } from "../shared/packing.ts";
import type { Fault } from "../shared/types.ts";
import { release } from "./renderer.ts";
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

export class Session extends Entering<Entered> {
  static readonly of = oneFor((channel) => new Session(channel));

  scene: Scene | null = null;
  tiles: Tiles | null = null;
  common: Common | null = null;
  /** The step of the derivation that is looked at. */
  step = 0;
  /** What is asked in one view keeps back steps of all views. */
  readonly veils = new Set<(steps: Step[]) => Step[]>();
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
  get report(): string {
    return this.scene?.report ?? "";
  }
  /** What is shown of the steps: while one is asked for, not that one and what comes behind it. */
  get steps(): Step[] {
    return [...this.veils].reduce((steps, veil) => veil(steps), this.allSteps);
  }
  get allSteps(): Step[] {
    return this.channel.get<Step[]>("steps");
  }
  get point(): Pair | null {
    const point = this.channel.get<number[]>("point");
    return point.length === 2 ? (point as Pair) : null;
  }
  /** A picture in PNG or JPEG, where one was drawn for pages that cannot draw. */
  get still(): Uint8Array<ArrayBuffer> | null {
    const bytes = this.channel.get<Bytes>("still");
    return byteLength(bytes) ? bytesOf(bytes) : null;
  }
  /** Whether a text is on its way. */
  get typing(): boolean {
    return this.coming("text");
  }
  override hold(update: () => void, signal: AbortSignal): void {
    super.hold(update, signal);
    update();
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

  private readonly onSteps = (): void => {
    this.step = Math.max(0, this.steps.length - 1);
    this.tell();
  };
  protected override begin(): void {
    super.begin();
    for (const name of PLAIN) this.listen(name, () => this.tell());
    for (const name of PACKED) this.listen(name, () => void this.unpack());
    this.listen("steps", this.onSteps);
    this.step = Math.max(0, this.steps.length - 1);
    void this.unpack();
  }

  protected override end(): void {
    release(this);
    this.scene = this.tiles = this.common = null;
    super.end();
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
