// What a pointer does to a picture that one looks around in: it drags, clicks, and the wheel goes nearer.

import { focused } from "./dom.ts";

const STILL = 4; // pixels up to which a press is a click

interface Pointed {
  /** A click at a place of the picture, 0 to 1 from its lower left. */
  clicked(across: number, up: number): void;
  /** The pointer has gone so many pixels of the page, held down. */
  dragged(dx: number, dy: number, event: PointerEvent): void;
  /** The wheel was turned so far, in pixels of a page that would scroll; at a place as that of a click. */
  wheeled(by: number, across: number, up: number): void;
  /** The pointer is at a place without being held down; null: it has left. */
  hovered?(at: { across: number; up: number } | null): void;
  /** Whether the other two buttons drag, too. */
  all?: boolean;
}

export function pointing(canvas: HTMLCanvasElement, { clicked, dragged, wheeled, hovered, all }: Pointed): void {
  const placeOf = (event: MouseEvent): [across: number, up: number] => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
  };
  let held: { x: number; y: number; moved: number } | null = null;
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 && !(all && event.button <= 2)) return;
    if (event.button === 1) event.preventDefault(); // the page would scroll by itself
    held = { x: event.clientX, y: event.clientY, moved: 0 };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) {
      const [across, up] = placeOf(event);
      hovered?.({ across, up });
      return;
    }
    const [dx, dy] = [event.clientX - held.x, event.clientY - held.y];
    held = { x: event.clientX, y: event.clientY, moved: held.moved + Math.abs(dx) + Math.abs(dy) };
    if (held.moved > STILL) dragged(dx, dy, event);
  });
  canvas.addEventListener("pointerup", (event) => {
    if (held && held.moved <= STILL && event.button === 0) clicked(...placeOf(event));
    held = null;
  });
  canvas.addEventListener("pointercancel", () => {
    held = null;
  });
  if (hovered) canvas.addEventListener("pointerleave", () => hovered(null));
  const menu = (event: Event) => {
    event.preventDefault();
    event.stopPropagation(); // JupyterLab has a menu of its own
  };
  if (all) canvas.addEventListener("contextmenu", menu);
  canvas.addEventListener(
    "wheel",
    (event) => {
      // The page scrolls until the picture is chosen.
      if (focused(canvas) !== canvas && !(all && (event.ctrlKey || event.metaKey))) return;
      event.preventDefault();
      event.stopPropagation();
      wheeled(Math.min(400, Math.max(-400, event.deltaY)) * (event.deltaMode ? LINE : 1), ...placeOf(event));
    },
    { passive: false },
  );
}

const LINE = 32; // pixels of a line
