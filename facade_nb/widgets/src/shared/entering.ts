// What was entered in the views of a channel but is not yet answered. One message is on its way at a time; of several
// values for one name only the last is sent; undo and redo are kept in order with them.

import { type Entry, Pauses } from "./pause.ts";
import { Shared } from "./shared.ts";
import type { WidgetModel } from "./types.ts";

interface Queued<Name> {
  message: Entry;
  /** What it sets; "": nothing, it asks for something. */
  name: Name | "";
}

export abstract class Entering<Name extends string> extends Shared {
  private seq = 0;
  /** What was entered and is not yet sent; what is sent and not yet answered. Views show these. */
  private queue: Queued<Name>[] = [];
  private flying: Queued<Name> | null = null;
  /** The operation that was sent last. */
  private last = "";
  private readonly pauses = new Pauses();

  protected constructor(channel: WidgetModel) {
    super(channel);
  }

  get canUndo(): boolean {
    return this.channel.get<boolean>("can_undo") || this.queue.length > 0 || this.flying !== null;
  }
  get canRedo(): boolean {
    return this.channel.get<boolean>("can_redo");
  }
  /** Whether what changes now does so because it is undone or redone. */
  get undoing(): boolean {
    return this.last === "undo" || this.last === "redo";
  }
  /** Whether something was entered that Python has not answered. */
  get waits(): boolean {
    return this.entered().length > 0;
  }

  /** Take a value: it is shown at once, and sent at once or when the answer to what was sent before has come. */
  set(name: Name, value: unknown): void {
    if (this.kernel.presence === "saved") this.channel.set(name, value);
    else {
      const message = { op: "set", name, value };
      // What was asked for in between is about the value before it.
      const since = this.queue.findLastIndex((queued) => queued.name === "");
      const waiting = this.queue.find((queued, i) => i > since && queued.name === name);
      const entry = this.pauses.enter(message, waiting?.message);
      if (waiting) waiting.message = entry;
      else this.queue.push({ message: entry, name });
      this.flush();
    }
    this.tell();
  }

  /** Go one step back or forward; kept in order with what is entered. */
  ask(op: "undo" | "redo"): void {
    this.request({ op });
  }

  /** Ask for something; kept in order with what is entered. */
  protected request(message: { op: string; [argument: string]: unknown }): void {
    if (!this.live) return;
    this.queue.push({ message, name: "" });
    this.flush();
    this.tell();
  }

  protected value<T>(name: Name): T {
    const own = this.own(name);
    return own ? (own.message.value as T) : this.channel.get<T>(name);
  }

  /** Whether a value of that name is on its way. */
  protected coming(name: Name): boolean {
    return this.own(name) !== undefined;
  }

  /** The last message on its way that sets this. */
  private own(name: Name): Queued<Name> | undefined {
    const set = (queued: Queued<Name>) => queued.name === name;
    return this.queue.findLast(set) ?? (this.flying && set(this.flying) ? this.flying : undefined);
  }

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
  private entered(): Queued<Name>[] {
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

  private readonly onAck = (): void => {
    const ack = this.channel.get<{ client?: string; seq?: number }>("ack");
    if (ack.client !== this.client) return;
    if ((ack.seq ?? 0) < this.seq) return;
    this.flying = null;
    this.flush();
    this.tell();
  };

  protected begin(): void {
    this.listen("ack", this.onAck);
  }

  protected end(): void {
    if (this.kernel.presence === "gone") return; // a view that is made later shows what was entered, and says so
    this.flying = null;
    this.queue = [];
  }
}
