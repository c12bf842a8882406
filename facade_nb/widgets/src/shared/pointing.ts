// What a pointer does to a picture that one looks around in: it drags, clicks, and the wheel goes nearer.

import { focused } from "./dom.ts";

const STILL = 4; // pixels up to which a press is a click

interface Pointed {
  /** A click at a place of the picture, 0 to 1 from its lower left. */
  clicked(across: number, up: number): void;
  /** The pointer has gone so many pixels of the page, held down. */
  dragged(dx: number, dy: number, event: PointerEvent): void;
  /** The wheel was turned so far, in pixels of a page that would scroll. */
  wheeled(by: number): void;
}

export function pointing(canvas: HTMLCanvasElement, { clicked, dragged, wheeled }: Pointed): void {
  let held: { x: number; y: number; moved: number } | null = null;
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    held = { x: event.clientX, y: event.clientY, moved: 0 };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const [dx, dy] = [event.clientX - held.x, event.clientY - held.y];
    held = { x: event.clientX, y: event.clientY, moved: held.moved + Math.abs(dx) + Math.abs(dy) };
    if (held.moved > STILL) dragged(dx, dy, event);
  });
  canvas.addEventListener("pointerup", (event) => {
    if (held && held.moved <= STILL) {
      const box = canvas.getBoundingClientRect();
      clicked((event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height);
    }
    held = null;
  });
  canvas.addEventListener("pointercancel", () => {
    held = null;
  });
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (focused(canvas) !== canvas) return; // the page scrolls until the picture is chosen
      event.preventDefault();
      event.stopPropagation();
      wheeled(Math.min(400, Math.max(-400, event.deltaY)) * (event.deltaMode ? LINE : 1));
    },
    { passive: false },
  );
}

const LINE = 32; // pixels of a line
