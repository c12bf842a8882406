// A canvas that can be panned and zoomed: by wheel (Ctrl, or while it has the focus), by dragging, by keys and buttons.

import { focused, h } from "../../shared/dom.ts";
import { afterDrawing, cancelFrame } from "../redraw.ts";

export interface Camera {
  /** The point of the drawing at the canvas's upper left corner, and pixels per unit. */
  x: number;
  y: number;
  scale: number;
}

export interface Point {
  x: number;
  y: number;
}

interface Options {
  label: string;
  /** The drawing's extent, in its own units, and pixels to leave free around it. */
  bounds(): { left: number; top: number; right: number; bottom: number };
  margin: { left: number; top: number; right: number; bottom: number };
  draw(context: CanvasRenderingContext2D, camera: Camera, width: number, height: number): void;
  hover(at: Point | null): void;
  press(at: Point): void;
  key(event: KeyboardEvent): boolean;
}

const CLICK = 4; // pixels that a press may move and still be a click

export class Plane {
  readonly el: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  camera: Camera = { x: 0, y: 0, scale: 1 };
  private width = 0;
  private height = 0;
  private moved = false;
  private readonly context: CanvasRenderingContext2D | null;

  constructor(
    private readonly options: Options,
    private readonly signal: AbortSignal,
  ) {
    this.canvas = h("canvas", { class: "fnb-plane-canvas", tabindex: 0, role: "img", "aria-label": options.label });
    const button = (label: string, text: string, act: () => void) => {
      const made = h("button", { type: "button", class: "fnb-button", title: label, "aria-label": label }, text);
      made.addEventListener("click", act, { signal });
      return made;
    };
    this.el = h(
      "div",
      { class: "fnb-plane" },
      this.canvas,
      h(
        "div",
        { class: "fnb-plane-tools" },
        button("Zoom in", "+", () => this.zoom(1.5)),
        button("Zoom out", "−", () => this.zoom(1 / 1.5)),
        button("Show all", "⤢", () => this.fit()),
      ),
    );
    this.context = contextOf(this.canvas);
    this.listen();
    if (typeof ResizeObserver !== "undefined") {
      const observer = new ResizeObserver(() => this.resize());
      observer.observe(this.canvas);
      signal.addEventListener("abort", () => observer.disconnect());
    }
    signal.addEventListener("abort", () => cancelFrame(this.repaint));
  }

  /** Show the whole drawing. */
  fit(): void {
    this.moved = false;
    this.place();
    this.invalidate();
  }

  /** Draw again, once, at the end of this frame or of the next. */
  invalidate(): void {
    if (this.context && !this.signal.aborted) afterDrawing(this.repaint);
  }

  private readonly repaint = (): void => this.paint();

  /** The drawing has another extent now: show all of it, unless the reader has moved it. */
  settle(): void {
    if (!this.moved) this.place();
    this.invalidate();
  }

  /** Move so that a point can be seen. */
  reveal({ x, y }: Point): void {
    const [sx, sy] = [(x - this.camera.x) * this.camera.scale, (y - this.camera.y) * this.camera.scale];
    const { left, top } = this.options.margin;
    if (sx >= left && sx <= this.width - 20 && sy >= top && sy <= this.height - 20) return;
    this.moved = true;
    this.camera.x = x - this.width / 2 / this.camera.scale;
    this.camera.y = y - this.height / 2 / this.camera.scale;
  }

  private place(): void {
    const { left, top, right, bottom } = this.options.bounds();
    const { margin } = this.options;
    const room = {
      x: Math.max(10, this.width - margin.left - margin.right),
      y: Math.max(10, this.height - margin.top - margin.bottom),
    };
    const scale = Math.min(room.x / Math.max(right - left, 1e-9), room.y / Math.max(bottom - top, 1e-9));
    this.camera = {
      scale,
      x: left - (margin.left + (room.x - (right - left) * scale) / 2) / scale,
      y: top - (margin.top + (room.y - (bottom - top) * scale) / 2) / scale,
    };
  }

  private resize(): void {
    const { width, height } = this.canvas.getBoundingClientRect();
    if (!width || !height) return;
    const ratio = window.devicePixelRatio || 1;
    this.width = width;
    this.height = height;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    if (!this.moved) this.place();
    this.paint(); // a canvas that was resized is blank: not a frame later
  }

  private paint(): void {
    const { context } = this;
    if (!context || !this.width) return;
    const ratio = window.devicePixelRatio || 1;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    this.options.draw(context, this.camera, this.width, this.height);
  }

  private zoom(by: number, at = { x: this.width / 2, y: this.height / 2 }): void {
    const { x, y, scale } = this.camera;
    const next = Math.max(0.5, Math.min(600, scale * by));
    this.moved = true;
    this.camera = { scale: next, x: x + at.x / scale - at.x / next, y: y + at.y / scale - at.y / next };
    this.invalidate();
  }

  private pan(dx: number, dy: number): void {
    this.moved = true;
    this.camera.x -= dx / this.camera.scale;
    this.camera.y -= dy / this.camera.scale;
    this.invalidate();
  }

  private world(event: MouseEvent): Point {
    const box = this.canvas.getBoundingClientRect();
    const { x, y, scale } = this.camera;
    return { x: x + (event.clientX - box.left) / scale, y: y + (event.clientY - box.top) / scale };
  }

  private listen(): void {
    const { canvas, signal, options } = this;
    let from: { x: number; y: number; dragged: boolean } | null = null;
    canvas.addEventListener(
      "wheel",
      (event) => {
        // A page is scrolled over the canvas, unless the reader is at work in it.
        if (!event.ctrlKey && !event.metaKey && focused(canvas) !== canvas) return;
        event.preventDefault();
        const box = canvas.getBoundingClientRect();
        this.zoom(Math.exp(-event.deltaY * 0.002), { x: event.clientX - box.left, y: event.clientY - box.top });
      },
      { signal, passive: false },
    );
    canvas.addEventListener(
      "pointerdown",
      (event) => {
        from = { x: event.clientX, y: event.clientY, dragged: false };
        canvas.setPointerCapture?.(event.pointerId);
      },
      { signal },
    );
    canvas.addEventListener(
      "pointermove",
      (event) => {
        if (from && (event.buttons & 1) !== 0) {
          const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
          if (!from.dragged && Math.hypot(dx, dy) < CLICK) return;
          from = { x: event.clientX, y: event.clientY, dragged: true };
          this.pan(dx, dy);
        } else options.hover(this.world(event));
      },
      { signal },
    );
    canvas.addEventListener(
      "pointerup",
      (event) => {
        if (from && !from.dragged) options.press(this.world(event));
        from = null;
      },
      { signal },
    );
    canvas.addEventListener("pointerleave", () => options.hover(null), { signal });
    canvas.addEventListener(
      "keydown",
      (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const zooms: Record<string, () => void> = {
          "+": () => this.zoom(1.3),
          "=": () => this.zoom(1.3),
          "-": () => this.zoom(1 / 1.3),
          "0": () => this.fit(),
        };
        const known = zooms[event.key];
        if (known) known();
        if (known || options.key(event)) event.preventDefault();
      },
      { signal },
    );
  }
}

/** Null where there is no canvas to draw on, as in tests without a browser. */
function contextOf(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  if (typeof CanvasRenderingContext2D === "undefined") return null;
  return canvas.getContext("2d");
}
