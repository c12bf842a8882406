// The browser's end of a channel: the state that Python describes, and a queue of what was edited.
//
// One message is under way at a time. Of several values for one field, only the newest waits. So a slow kernel is not
// flooded, and a fast one sees every keystroke.

import { Kernel } from "./kernel.ts";
import { Pauses } from "./pause.ts";
import { announce } from "./presence.ts";
import type { Path, Reply, State, WidgetModel } from "./types.ts";

export type Operation = { op: string; [argument: string]: unknown };
type Key = keyof State;

/** Milliseconds that what is beside the elevation waits for a frame at most. */
const UNSEEN = 100;

interface Queued {
  message: Operation;
  key: string;
}

/** A field, and what was typed in it. */
export interface Edit {
  path: Path;
  value: unknown;
}

export const keyOf = (path: Path): string => JSON.stringify(path);

export class Store {
  readonly client = Math.random().toString(36).slice(2);
  private queue: Queued[] = [];
  private flying: (Queued & { seq: number; since: number }) | null = null;
  private seq = 0;
  /** The operation that was sent last. */
  private last = "";
  /** What was asked to have another name: what waits for it meanwhile is about the new one. */
  private renames: { section: "patterns" | "symbols" | "counters" | "layers"; name: string; to: string }[] = [];
  private readonly waiters = new Set<() => void>();
  private readonly pauses = new Pauses();
  /** What is to be brought up to date once the elevation has been painted; null: the elevation is as it was. */
  private behind: Set<() => unknown> | null = null;

  readonly kernel: Kernel;

  constructor(
    readonly channel: WidgetModel,
    private readonly signal: AbortSignal,
  ) {
    this.kernel = Kernel.of(channel);
    this.listen("change:ack", () => this.answered());
    this.listen("change:svg", () => this.letPaint());
    announce(channel, this.client, signal);
    this.kernel.watch(() => this.kernelChanged(), signal);
  }

  get<K extends Key>(key: K): State[K] {
    return this.channel.get<State[K]>(key);
  }

  /** False in a saved notebook without a kernel, and while the kernel is away: all can be seen, nothing edited. */
  get live(): boolean {
    return this.kernel.live;
  }

  /** What the ids in the drawing begin with. */
  get prefix(): string {
    return `f${this.channel.model_id}`;
  }

  /**
   * Call back now, and after every message that changed one of `keys`. Where the message brings another elevation, all
   * but what is `first` waits until that has been painted.
   */
  watch(keys: Key[], callback: () => void, when: "first" | "in turn" = "in turn"): void {
    callback();
    let due = false;
    const run = () => {
      due = false;
      if (!this.signal.aborted) callback();
    };
    const changed = () => {
      // A message sets its traits one by one: wait for the last, but not for the next frame.
      if (due) return;
      due = true;
      queueMicrotask(() => {
        if (this.behind && when !== "first") this.behind.add(run);
        else run();
      });
    };
    for (const key of keys) this.listen(`change:${key}`, changed);
  }

  /** Keep what waits until the next frame has been painted; a page that is not seen paints none, and waits a moment. */
  private letPaint(): void {
    if (this.behind) return;
    const behind = new Set<() => unknown>();
    this.behind = behind;
    const end = () => {
      clearTimeout(timer);
      if (this.behind !== behind) return;
      this.behind = null;
      for (const run of behind) run();
    };
    const timer = window.setTimeout(end, UNSEEN);
    requestAnimationFrame(() => setTimeout(end));
  }

  /** Call back when an edit is put under way or answered, and when the kernel has gone or come back. */
  watchQueue(callback: () => void): void {
    this.waiters.add(callback);
    this.signal.addEventListener("abort", () => this.waiters.delete(callback));
  }

  onReply(callback: (reply: Reply) => void): void {
    this.listen("msg:custom", (reply: Reply) => {
      if (reply.client !== this.client) return;
      // It is about what the message before has changed: the parts show that first.
      const tell = () => this.signal.aborted || callback(reply);
      if (this.behind) queueMicrotask(() => (this.behind ? this.behind.add(tell) : tell()));
      else tell();
    });
  }

  /** Edit a field. */
  set(path: Path, value: unknown): void {
    const key = keyOf(path);
    const message = { op: "set", path, value };
    // What was asked for in between, such as undo, is about the value before it.
    const since = this.queue.findLastIndex((queued) => queued.key === "");
    const waiting = this.queue.find((queued, i) => i > since && queued.key === key);
    const entry = this.pauses.enter(message, waiting?.message);
    if (waiting) waiting.message = entry;
    else this.queue.push({ message: entry, key });
    this.flush();
  }

  /** Ask for anything else; kept in order with the edits. Nothing is asked of a kernel that is away. */
  ask(message: Operation): void {
    if (!this.live) return;
    this.queue.push({ message, key: "" });
    this.flush();
  }

  /** Whether Python does not know yet what stands in a field. */
  pending(path: Path): boolean {
    const key = keyOf(path);
    return this.flying?.key === key || this.queue.some((queued) => queued.key === key);
  }

  /** Whether what changes now does so because it is undone or redone. */
  get undoing(): boolean {
    return this.last === "undo" || this.last === "redo";
  }

  /** What was typed in a field of any view, and did not reach the kernel before it went. */
  unsent(path: Path): unknown {
    const key = keyOf(path);
    return this.live ? undefined : this.left().findLast((edit) => keyOf(edit.path) === key)?.value;
  }

  /** Whether there are edits that have not reached the kernel; where it has gone, of any view. */
  get waits(): boolean {
    return this.edits().length > 0 || (this.kernel.presence === "gone" && this.left().length > 0);
  }

  /** Milliseconds that the message under way has been waited for. */
  get waiting(): number {
    return this.flying ? performance.now() - this.flying.since : 0;
  }

  private flush(): void {
    if (this.flying || !this.live) return;
    const next = this.queue.shift();
    if (!next) return;
    this.readdress(next);
    this.last = next.message.op;
    this.flying = { ...next, seq: ++this.seq, since: performance.now() };
    this.send();
    for (const waiter of this.waiters) waiter();
  }

  /** What is typed in a field whose pattern, say, was renamed a moment ago goes to where the field is now. */
  private readdress(next: Queued): void {
    const { op, kind, name, to, path } = next.message;
    if (op === "rename") {
      const section = { pattern: "patterns", symbol: "symbols", counter: "counters", layer: "layers" } as const;
      const own = section[kind as keyof typeof section];
      if (own) this.renames = [...this.renames.slice(-9), { section: own, name: String(name), to: String(to).trim() }];
    }
    if (op !== "set") return;
    const there = (section: string, name?: string) =>
      (this.get("design")[section as "patterns"] ?? []).some((other) => other.name === name);
    let [section, own, ...rest] = path as Path;
    for (const rename of this.renames)
      if (rename.section === section && rename.name === own && !there(section, own) && there(section, rename.to))
        own = rename.to;
    if (section === undefined || own === undefined || own === (path as Path)[1]) return;
    next.message = { ...next.message, path: [section, own, ...rest] };
    next.key = keyOf([section, own, ...rest]);
  }

  private send(): void {
    if (this.flying) this.kernel.tell({ ...this.flying.message, client: this.client, seq: this.flying.seq });
  }

  /** After a gap what was under way is sent again, if it was lost; when the kernel has gone, what was typed is kept. */
  private kernelChanged(): void {
    if (this.live && this.flying) {
      this.flying.since = performance.now();
      if (this.kernel.received(this.client) < this.flying.seq) this.send();
      else this.flying = null;
    }
    this.flush();
    // In the browser's model all views of the channel find it, those that are made later too.
    if (this.kernel.presence === "gone" && this.edits().length > 0) {
      const keys = new Set(this.edits().map(({ path }) => keyOf(path)));
      this.channel.set("unsent", [...this.left().filter(({ path }) => !keys.has(keyOf(path))), ...this.edits()]);
    }
    for (const waiter of this.waiters) waiter();
  }

  /** The edits that are under way or wait, oldest first. */
  private edits(): Edit[] {
    const all = this.flying ? [this.flying, ...this.queue] : this.queue;
    return all.flatMap(({ message: { op, path, value } }) => (op === "set" ? [{ path: path as Path, value }] : []));
  }

  private left(): Edit[] {
    return this.channel.get<Edit[] | undefined>("unsent") ?? [];
  }

  private answered(): void {
    const ack = this.get("ack");
    if (!this.flying || ack.client !== this.client || (ack.seq ?? 0) < this.flying.seq) return;
    this.flying = null;
    this.flush();
    for (const waiter of this.waiters) waiter();
  }

  // biome-ignore lint/suspicious/noExplicitAny: Backbone's events carry different arguments
  private listen(name: string, callback: (...args: any[]) => void): void {
    this.channel.on(name, callback);
    this.signal.addEventListener("abort", () => this.channel.off(name, callback));
  }
}
