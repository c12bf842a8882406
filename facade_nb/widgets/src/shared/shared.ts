// What the views of one channel on a page share. It begins with the first view that holds it, and ends with the last.

import { Kernel } from "./kernel.ts";
import { announce } from "./presence.ts";
import type { WidgetModel } from "./types.ts";

export abstract class Shared {
  readonly client = Math.random().toString(36).slice(2);
  protected readonly views = new Set<() => void>();
  readonly kernel: Kernel;
  protected present = new AbortController();

  protected constructor(protected readonly channel: WidgetModel) {
    this.kernel = Kernel.of(channel);
    keepBytes(channel);
  }

  /** False in a saved notebook without a kernel, and while the kernel is away. */
  get live(): boolean {
    return this.kernel.live;
  }

  get trouble(): string {
    return this.channel.get<string>("trouble");
  }

  /** Hold it for a view until the signal ends; `update` is called when something has changed. */
  hold(update: () => void, signal: AbortSignal): void {
    if (this.views.size === 0) {
      this.present = new AbortController();
      announce(this.channel, this.client, this.present.signal);
      this.kernel.watch(() => this.kernelChanged(), this.present.signal);
      this.begin();
    }
    this.views.add(update);
    signal.addEventListener("abort", () => {
      this.views.delete(update);
      if (this.views.size > 0) return;
      this.end();
      this.present.abort("ended");
    });
  }

  /** Be called when a trait changes, as long as there are views. */
  protected listen(name: string, call: () => void): void {
    this.channel.on(`change:${name}`, call);
    this.present.signal.addEventListener("abort", () => this.channel.off(`change:${name}`, call));
  }

  protected tell(): void {
    for (const update of [...this.views]) update();
  }

  /** The kernel has come back, or gone. */
  protected kernelChanged(): void {
    this.tell();
  }

  protected abstract begin(): void;
  protected abstract end(): void;
}

/** A model is saved with a notebook by way of JSON, in which bytes are lost. anywidget's own model keeps them like this. */
function keepBytes(channel: WidgetModel): void {
  channel.serialize = (state) => {
    for (const [name, value] of Object.entries(state)) {
      const own = value as { toJSON?: () => unknown } | null;
      state[name] = typeof own?.toJSON === "function" ? own.toJSON() : structuredClone(value);
    }
    return state;
  };
}
