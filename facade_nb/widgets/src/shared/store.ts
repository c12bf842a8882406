// The browser's end of a channel: the state that Python describes, and a queue of what was edited.
//
// One message is under way at a time. Of several values for one field, only the newest waits. So a slow kernel is not
// flooded, and a fast one sees every keystroke.

import { announce } from "./presence.ts";
import type { Path, Reply, State, WidgetModel } from "./types.ts";

export type Operation = { op: string; [argument: string]: unknown };
type Key = keyof State;

interface Queued {
  message: Operation;
  key: string;
}

export const keyOf = (path: Path): string => JSON.stringify(path);

export class Store {
  readonly client = Math.random().toString(36).slice(2);
  private queue: Queued[] = [];
  private flying: (Queued & { seq: number; since: number }) | null = null;
  private seq = 0;
  /** The operation that was sent last. */
  private last = "";
  private readonly waiters = new Set<() => void>();

  constructor(
    private readonly channel: WidgetModel,
    private readonly signal: AbortSignal,
  ) {
    this.listen("change:ack", () => this.answered());
    announce(channel, this.client, signal);
  }

  get<K extends Key>(key: K): State[K] {
    return this.channel.get<State[K]>(key);
  }

  /** False in a saved notebook without a kernel: all can be seen, nothing edited. */
  get live(): boolean {
    return this.channel.comm_live !== false;
  }

  /** What the ids in the drawing begin with. */
  get prefix(): string {
    return `f${this.channel.model_id}`;
  }

  /** Call back now, and after every message that changed one of `keys`. */
  watch(keys: Key[], callback: () => void): void {
    callback();
    let due = false;
    const changed = () => {
      // A message sets its traits one by one: wait for the last, but not for the next frame.
      if (due) return;
      due = true;
      queueMicrotask(() => {
        due = false;
        if (!this.signal.aborted) callback();
      });
    };
    for (const key of keys) this.listen(`change:${key}`, changed);
  }

  /** Call back when an edit is put under way or answered. */
  watchQueue(callback: () => void): void {
    this.waiters.add(callback);
    this.signal.addEventListener("abort", () => this.waiters.delete(callback));
  }

  onReply(callback: (reply: Reply) => void): void {
    this.listen("msg:custom", (reply: Reply) => {
      if (reply.client === this.client) callback(reply);
    });
  }

  /** Edit a field. */
  set(path: Path, value: unknown): void {
    const key = keyOf(path);
    const message = { op: "set", path, value };
    // What was asked for in between, such as undo, is about the value before it.
    const since = this.queue.findLastIndex((queued) => queued.key === "");
    const waiting = this.queue.find((queued, i) => i > since && queued.key === key);
    if (waiting) waiting.message = message;
    else this.queue.push({ message, key });
    this.flush();
  }

  /** Ask for anything else; kept in order with the edits. */
  ask(message: Operation): void {
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

  /** Milliseconds that the message under way has been waited for. */
  get waiting(): number {
    return this.flying ? performance.now() - this.flying.since : 0;
  }

  private flush(): void {
    if (this.flying || !this.live) return;
    const next = this.queue.shift();
    if (!next) return;
    this.last = next.message.op;
    this.flying = { ...next, seq: ++this.seq, since: performance.now() };
    this.channel.send({ ...next.message, client: this.client, seq: this.seq });
    for (const waiter of this.waiters) waiter();
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
