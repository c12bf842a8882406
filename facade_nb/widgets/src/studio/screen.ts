// Full screen: the whole widget, where the browser lets it.

import { mark } from "../shared/dom.ts";
import { button } from "../shared/fields.ts";
import type { Context } from "./common.ts";

/** A button that gives the widget the whole screen, and takes it back; so does Escape, where nothing is picked. */
export function fullScreen({ store, signal }: Context): HTMLButtonElement {
  const picked = () => {
    const { layer, x, y } = store.get("selection");
    return layer + x + y !== "";
  };
  const root = () => el.closest<HTMLElement>(".fnb");
  // In a shadow tree the document names only what holds the tree.
  const on = () => {
    const tree = el.getRootNode() as Document | ShadowRoot;
    return tree.fullscreenElement !== null && tree.fullscreenElement === root();
  };
  const el: HTMLButtonElement = button("Full screen", "full", () => {});
  const leave = async () => {
    try {
      await document.exitFullscreen();
    } catch {
      // It was left already.
    }
  };
  el.addEventListener("click", async (event) => {
    // A script's press would not be granted, but would use up what lets other buttons reach the clipboard.
    if (!event.isTrusted) return;
    if (on()) {
      await leave();
      return;
    }
    try {
      await root()?.requestFullscreen?.();
    } catch {
      // The host does not allow it: all goes on as it was.
    }
  });
  document.addEventListener("fullscreenchange", () => mark(el, "aria-pressed", String(on())), { signal });
  document.addEventListener(
    "keydown",
    (event) => {
      if (event.key === "Escape" && !event.defaultPrevented && !picked() && on()) void leave();
    },
    { signal },
  );
  return el;
}
