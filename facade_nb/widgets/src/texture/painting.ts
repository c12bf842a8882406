// When a picture is drawn, and how finely: coarse while it moves, sharp when it rests, then smooth, in bands of rows between
// which the page can do other things. Anything that changes begins anew.

import { context } from "../pipeline/context.ts";
import { mark } from "../shared/dom.ts";
import { draw, type Job, smoothReady } from "./renderer.ts";

const BUDGET = 45; // milliseconds of a frame while it moves, and of a band of the sharp picture
const IDLE = 30; // milliseconds of a band of the smooth one
const RESTED = 160; // milliseconds after which it is drawn sharply
const COARSEST = 12;
const STEPS = [1, 1.5, 2, 3, 4, 6, 8, COARSEST]; // few, so that few sizes of images are made

/** How coarse the next frame should be: 1 is sharp. From the time that the last one took, of so many pixels. */
export function coarser(milliseconds: number, pixels: number, full: number): number {
  const affordable = (pixels * BUDGET) / Math.max(milliseconds, 1);
  return Math.min(COARSEST, Math.max(1, Math.sqrt(full / affordable)));
}

/** How many rows the next band should have. */
export function rowsFor(budget: number, rows: number, milliseconds: number): number {
  return Math.min(1024, 4 * rows, Math.max(1, Math.round((rows * budget) / Math.max(milliseconds, 1))));
}

export interface Painting {
  /** Draw it anew. */
  redraw(): void;
  stop(): void;
}

export function painting(
  canvas: HTMLCanvasElement,
  job: () => Job | null,
  smoothed: () => boolean,
  moved: () => void,
  failed: (message: string) => void,
): Painting {
  const paper = canvas.getContext("2d", { willReadFrequently: context().software }) as CanvasRenderingContext2D;
  let coarse = 1;
  let timer = 0;
  let frame = 0;
  const rows = { sharp: 24, smooth: 4 };

  const attempt = (act: () => void) => {
    try {
      act();
    } catch (error) {
      failed(error instanceof Error ? error.message : String(error));
    }
  };
  /** The whole picture at once, as coarse as the time allows. */
  const rough = () => {
    const now = job();
    if (!now || !canvas.width) return;
    const full = canvas.width * canvas.height;
    coarse = STEPS.find((own) => own >= coarse - 0.01) ?? COARSEST;
    const [width, height] = [Math.ceil(canvas.width / coarse), Math.ceil(canvas.height / coarse)];
    const began = performance.now();
    if (!draw(now, paper, width, height)) return;
    mark(canvas, "data-coarse", coarse.toFixed(2));
    coarse = coarser(performance.now() - began, width * height, full);
  };
  /** The picture in bands, from its lower edge on. */
  const bands = (how: "sharp" | "smooth", low: number) =>
    attempt(() => {
      const now = job();
      if (!now || !canvas.width) return;
      if (how === "smooth" && !smoothReady(now)) {
        timer = window.setTimeout(() => bands(how, low), 40);
        return;
      }
      const high = Math.min(canvas.height, low + rows[how]);
      const began = performance.now();
      if (!draw(now, paper, canvas.width, canvas.height, low, high, how === "smooth")) return;
      rows[how] = rowsFor(how === "smooth" ? IDLE : BUDGET, high - low, performance.now() - began);
      if (high < canvas.height) timer = window.setTimeout(() => bands(how, high), 0);
      else {
        mark(canvas, "data-state", how);
        if (how === "sharp" && smoothed()) timer = window.setTimeout(() => bands("smooth", 0), 0);
      }
    });
  return {
    redraw() {
      clearTimeout(timer);
      timer = window.setTimeout(() => bands("sharp", 0), RESTED);
      mark(canvas, "data-state", "moving");
      if (frame) return;
      frame = requestAnimationFrame(() => {
        frame = 0;
        attempt(rough);
        moved();
      });
    },
    stop() {
      clearTimeout(timer);
      cancelAnimationFrame(frame);
    },
  };
}
