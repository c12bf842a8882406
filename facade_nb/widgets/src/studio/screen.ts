// Full screen: the whole widget, where the browser lets it.

import { mark } from "../shared/dom.ts";
import { button } from "../shared/fields.ts";

/** A button that gives the widget the whole screen, and takes it back. */
export function fullScreen(signal: AbortSignal): HTMLButtonElement {
  const root = () => el.closest<HTMLElement>(".fnb");
  const el: HTMLButtonElement = button("Full screen", "full", () => {});
  el.addEventListener("click", async (event) => {
    // A script's press would not be granted, but would use up what lets other buttons reach the clipboard.
    if (!event.isTrusted) return;
    const own = root();
    try {
      if (document.fullscreenElement) await document.exitFullscreen();
      else await own?.requestFullscreen?.();
    } catch {
      // The host does not allow it: all goes on as it was.
    }
  });
  const told = () => {
    const on = document.fullscreenElement !== null && document.fullscreenElement === root();
    mark(el, "aria-pressed", String(on));
  };
  document.addEventListener("fullscreenchange", told, { signal });
  return el;
}
