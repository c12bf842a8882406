// anywidget's package defines itself as an AMD module: it is handed what it asks for, and what it makes is kept.

import * as base from "@jupyter-widgets/base";

export const modules = new Map<string, unknown>();

(globalThis as { define?: unknown }).define = (_: string[], make: (own: typeof base) => unknown) => {
  modules.set("anywidget", make(base));
};
