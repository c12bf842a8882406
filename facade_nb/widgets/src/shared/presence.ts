// Telling Python that somebody looks: while nobody does, it puts its large traits away.

import { Kernel } from "./kernel.ts";
import type { WidgetModel } from "./types.ts";

/** Say that a view is here, until the signal ends or the page goes. Does nothing without a kernel. */
export function announce(channel: WidgetModel, client: string, signal: AbortSignal): void {
  const kernel = Kernel.of(channel);
  const say = (here: boolean) => kernel.tell({ op: "view", client, here });
  say(true);
  kernel.watch(() => say(true), signal);
  signal.addEventListener("abort", () => say(false));
  // A page that is left or loaded again ends no view.
  window.addEventListener("pagehide", () => say(false), { signal });
  window.addEventListener("pageshow", (event) => event.persisted && say(true), { signal });
}
