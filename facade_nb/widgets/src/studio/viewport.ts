// Where the façade stands on the stage: fitted to it, or as it was zoomed and moved. All of it happens in the browser.

import { mark } from "../shared/dom.ts";
import type { Drawing } from "../shared/drawing.ts";

/** Pixels per metre, and the pixel of the stage at which the façade's lower left corner stands. */
export interface Camera {
  metre: number;
  left: number;
  bottom: number;
}

export interface Room {
  width: number;
  height: number;
}

/** Pixels that stay free around a fitted drawing: at its head for the tools, at its foot for what is said of it. */
export const PADDING = { side: 14, top: 42, foot: 20 };
const LIMITS = { least: 0.05, most: 4000 };
/** A press that moves less than this is a click. */
const STILL = 4;
/** Milliseconds after the last turn of the wheel at which the drawing is made sharp again. */
const SETTLED = 120;

/** The camera that shows the whole drawing as large as it gets. */
export function fitted(room: Room, drawing: Drawing, extra = { side: 0, foot: 0 }): Camera {
  const across = Math.max(1, room.width - 2 * (PADDING.side + extra.side));
  const up = Math.max(1, room.height - PADDING.top - PADDING.foot - extra.foot);
  const scale = Math.min(across / drawing.width, up / drawing.height);
  const [left, top] = [(room.width - drawing.width * scale) / 2, PADDING.top + (up - drawing.height * scale) / 2];
  return {
    metre: drawing.scale * scale,
    left: left + drawing.origin.x * scale,
    bottom: top + drawing.origin.y * scale,
  };
}

/** The camera after a zoom by a factor, with one point of the stage kept where it is. */
export function zoomed(camera: Camera, factor: number, at: { x: number; y: number }): Camera {
  const metre = Math.min(LIMITS.most, Math.max(LIMITS.least, camera.metre * factor));
  const by = metre / camera.metre;
  return { metre, left: at.x + (camera.left - at.x) * by, bottom: at.y + (camera.bottom - at.y) * by };
}

/** The camera made smaller, its corner kept, so that a drawing that grows stays clear of the stage's right and upper end. */
export function clear(camera: Camera, room: Room, drawing: Drawing): Camera {
  const scale = camera.metre / drawing.scale;
  const across = (room.width - PADDING.side - camera.left) / (drawing.width - drawing.origin.x);
  const up = (camera.bottom - PADDING.top) / drawing.origin.y;
  const most = Math.max(Math.min(across, up), 0.001);
  return scale <= most ? camera : { ...camera, metre: most * drawing.scale };
}

interface Moved {
  camera(): Camera | null;
  /** Show from another camera; a rough picture will do while the hand still moves. */
  move(to: Camera, rough: boolean): void;
  fit(): void;
  /** Whether something that can be picked or dragged is there. */
  taken(target: EventTarget | null): boolean;
}

/** Zoom by wheel and keys, pan by dragging; a drag is no click. */
export function navigate(stage: HTMLElement, signal: AbortSignal, view: Moved): { zoom(factor: number): void } {
  let spaced = false;
  let dragged = false;
  let timer = 0;
  const listen = <K extends keyof HTMLElementEventMap>(
    name: K,
    callback: (event: HTMLElementEventMap[K]) => void,
    options: AddEventListenerOptions = {},
  ) => stage.addEventListener(name, callback, { signal, ...options });
  const place = (event: MouseEvent) => {
    const box = stage.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const zoom = (factor: number, at?: { x: number; y: number }, rough = false) => {
    const camera = view.camera();
    if (!camera) return;
    view.move(zoomed(camera, factor, at ?? { x: stage.clientWidth / 2, y: stage.clientHeight / 2 }), rough);
    clearTimeout(timer);
    if (rough) timer = window.setTimeout(sharpen, SETTLED);
  };
  const sharpen = () => {
    const camera = view.camera();
    if (camera && !signal.aborted) view.move(camera, false);
  };

  listen(
    "wheel",
    (event) => {
      if (!event.ctrlKey && !event.metaKey) return; // the page scrolls
      event.preventDefault();
      const lines = event.deltaMode === 0 ? event.deltaY : 33 * event.deltaY;
      zoom(Math.exp(-Math.max(-240, Math.min(240, lines)) / 240), place(event), true);
    },
    { passive: false },
  );
  listen("pointerdown", (down) => {
    dragged = false;
    const pans = down.button === 1 || (down.button === 0 && (spaced || !view.taken(down.target)));
    const from = view.camera();
    if (!pans || !from || isControl(down.target)) return;
    if (down.button === 1 || spaced) down.preventDefault();
    const move = (event: PointerEvent) => {
      const [dx, dy] = [event.clientX - down.clientX, event.clientY - down.clientY];
      if (!dragged && Math.hypot(dx, dy) < STILL) return;
      if (!dragged) {
        dragged = true;
        stage.setPointerCapture?.(down.pointerId);
        mark(stage, "data-panning", true);
      }
      view.move({ ...from, left: from.left + dx, bottom: from.bottom + dy }, true);
    };
    const end = () => {
      stage.removeEventListener("pointermove", move);
      for (const name of ["pointerup", "pointercancel"]) stage.removeEventListener(name, end);
      mark(stage, "data-panning", false);
      if (dragged) sharpen();
    };
    listen("pointermove", move);
    listen("pointerup", end);
    listen("pointercancel", end);
  });
  // A middle press would scroll the page by itself, or paste.
  listen("mousedown", (event) => event.button === 1 && event.preventDefault());
  listen("auxclick", (event) => event.button === 1 && event.preventDefault());
  listen(
    "click",
    (event) => {
      if (!dragged && !spaced) return;
      dragged = false;
      if (!isControl(event.target)) event.stopPropagation();
    },
    { capture: true },
  );
  const setSpaced = (on: boolean) => {
    spaced = on;
    mark(stage, "data-spaced", on);
  };
  listen("keydown", (event) => {
    if (event.target !== stage || event.ctrlKey || event.metaKey || event.altKey) return;
    const keys: Record<string, () => void> = {
      "+": () => zoom(1.25),
      "=": () => zoom(1.25),
      "-": () => zoom(0.8),
      "0": () => view.fit(),
      " ": () => setSpaced(true),
    };
    const action = keys[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
  listen("keyup", (event) => event.key === " " && setSpaced(false));
  listen("blur", () => setSpaced(false));
  signal.addEventListener("abort", () => clearTimeout(timer));
  return { zoom };
}

function isControl(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest("button, input, select, label, summary, .fnb-edge") !== null;
}
