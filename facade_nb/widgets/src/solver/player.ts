// The position in a trace, and its clock. All views of one trace follow one player; they are functions of its position.

import { played, type Timeline } from "./timeline.ts";

/** What a step goes to: the next event, or the next one of a kind. */
export const UNITS = { event: "event", node: "node", pass: "pass", improvement: "improvement" } as const;
export type Unit = keyof typeof UNITS;

export const SPEEDS = [1, 4, 16, 64, 256, 1024] as const;

export class Player {
  private at: number;
  private frame = 0;
  private since = 0;
  private from = 0;
  private readonly watchers = new Set<() => void>();
  speed: number = 16;
  /** What a step goes to. */
  unit: Unit = "event";
  private readonly stops = new Map<Unit, ArrayLike<number>>();

  constructor(
    readonly timeline: Timeline,
    position: number,
  ) {
    this.at = position < 0 ? timeline.last : this.clamp(position);
  }

  get position(): number {
    return this.at;
  }

  get playing(): boolean {
    return this.frame !== 0;
  }

  get atEnd(): boolean {
    return this.at >= this.timeline.last;
  }

  go(position: number): void {
    const next = this.clamp(position);
    if (this.playing) this.restart(next);
    if (next === this.at) return;
    this.at = next;
    this.tell();
  }

  /** Go so many steps on, of the unit that is chosen; where there is none that way, stay. */
  step(by: number): void {
    this.pause();
    if (this.unit === "event") {
      this.go(this.at + by);
      return;
    }
    const next = this.stopBeside(by);
    if (next !== undefined) this.go(next);
  }

  /** Whether a step leads anywhere. */
  canStep(by: 1 | -1): boolean {
    if (this.unit === "event") return by > 0 ? !this.atEnd : this.at > 0;
    return this.stopBeside(by) !== undefined;
  }

  setUnit(unit: Unit): void {
    this.unit = unit;
    this.tell();
  }

  private stopBeside(by: number): number | undefined {
    const stops = this.stopsOf(this.unit);
    const before = played(stops, this.at);
    return by > 0 ? stops[before] : stops[before - (stops[before - 1] === this.at ? 2 : 1)];
  }

  private stopsOf(unit: Unit): ArrayLike<number> {
    let found = this.stops.get(unit);
    if (!found) {
      const { kind, kinds, improved } = this.timeline.data;
      const wanted = kinds.indexOf(unit === "node" ? "NodeTaken" : "LimitRaised");
      found =
        unit === "improvement"
          ? improved
          : Array.from(kind.keys()).filter((position) => kind[position] === wanted && wanted >= 0);
      this.stops.set(unit, found);
    }
    return found;
  }

  /** Go to the first event of the next stage, or, back, of this one, or of the one before if it is there already. */
  stage(by: 1 | -1): void {
    const { stages } = this.timeline.data;
    const here = this.timeline.stageAt(this.at);
    if (by > 0) this.go(stages[here + 1]?.first ?? this.timeline.last);
    else if (this.at > (stages[here]?.first ?? 0)) this.go(stages[here]?.first ?? 0);
    else this.go(stages[here - 1]?.first ?? 0);
  }

  play(): void {
    if (this.playing) return;
    if (this.atEnd) this.at = 0;
    this.restart(this.at);
    this.frame = requestAnimationFrame(this.tick);
    this.tell();
  }

  pause(): void {
    if (!this.playing) return;
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.tell();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.restart(this.at);
    this.tell();
  }

  /** Call back when the position, or whether it is playing, has changed. */
  watch(callback: () => void, signal: AbortSignal): void {
    this.watchers.add(callback);
    signal.addEventListener("abort", () => this.watchers.delete(callback));
  }

  private readonly tick = (now: number): void => {
    const next = Math.min(this.timeline.last, this.from + Math.floor(((now - this.since) * this.speed) / 1000));
    const moved = next !== this.at;
    this.at = Math.max(this.at, next);
    this.frame = this.atEnd ? 0 : requestAnimationFrame(this.tick);
    if (moved || !this.frame) this.tell();
  };

  private restart(from: number): void {
    this.from = from;
    this.since = performance.now();
  }

  private clamp(position: number): number {
    return Math.max(0, Math.min(this.timeline.last, Math.round(position)));
  }

  private tell(): void {
    for (const watcher of [...this.watchers]) watcher();
  }
}
