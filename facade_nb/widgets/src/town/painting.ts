// When a picture is drawn, and how finely: coarse while one moves, as the time of frames allows; at rest finer, in pieces
// between which the page can do other things. Anything that changes begins anew.

import { context } from "../pipeline/context.ts";
import type { Pipeline, Shown } from "../pipeline/pipeline.ts";
import { mark } from "../shared/dom.ts";
import { rowsFor } from "../texture/painting.ts";
import { fading } from "./fading.ts";
import { frustumOf, type Sunlight, sunlightOf } from "./frame.ts";
import type { Head, Light, Pass, Pixels, Place, Values, Vector } from "./types.ts";

const BUDGET = 48; // milliseconds of a frame in motion, and of a piece of the picture at rest
const RESTED = 140; // milliseconds after which it becomes finer
export const FACTORS = [1, 1.5, 2, 3, 4, 6, 8, 12] as const;
const HELD = 0.075; // of a map's width that one may be away from where it was taken
const INDICES = 60_000; // of the mesh that a first piece draws

/** How coarse the next frame should be, after one that was so coarse and took so long. */
export function coarser(factor: number, milliseconds: number): number {
  const wanted = factor * Math.sqrt(milliseconds / BUDGET);
  if (wanted > factor) return FACTORS.find((own) => own >= wanted * 0.98) ?? 12;
  return FACTORS.findLast((own) => own >= wanted * 1.1 && own <= factor) === undefined
    ? factor
    : (FACTORS.find((own) => own >= wanted * 1.1) ?? factor);
}

/** What is drawn, and from where. */
export interface Scenery {
  /** Whether there is something to draw. */
  readonly drawable: boolean;
  readonly pipeline: Pipeline | null;
  readonly head: Pick<Head, "box" | "sunlight"> | null;
  readonly place: Place;
  readonly hour: number;
  readonly light: Light;
  /** The sun's views, where they are not those of whoever stands at the place. */
  sun?(): Sunlight;
  values(pixels: Pixels, off?: readonly string[], part?: [number, number, number, number], sun?: Sunlight): Values;
  passes(off?: readonly string[]): Pass[];
  runs(through: Float64Array, pixels?: Pixels): Pixels[];
}

/** Views of the sun, and where one stood then. */
interface Held {
  sun: Sunlight;
  eye: Vector;
  yaw: number;
  hour: number;
}

export const pixelsOf = ({ width, height }: HTMLCanvasElement, factor: number): Pixels => [
  Math.max(1, Math.ceil(width / factor)),
  Math.max(1, Math.ceil(height / factor)),
];

export interface Told {
  milliseconds: number;
  pixels: Pixels;
  factor: number;
  /** Milliseconds of each pass, where each was waited for. */
  spent: Map<string, number>;
}

export interface Painting {
  /** Draw it anew. */
  redraw(): void;
  /** Draw the same with what has come since: a picture at rest turns into a finer one. */
  refresh(): void;
  stop(): void;
  /** The last picture that was drawn as a whole; null: none. */
  readonly last: Pixels | null;
  /** Whether the picture is as fine as it will be, of what there was to draw when it was begun. */
  readonly done: boolean;
}

interface Options {
  off?: () => readonly string[];
  /** Which buffer is shown, and how; by default the last one. */
  shown?: () => [name: string, shown: Shown] | null;
  /** How coarse it is in motion at most. */
  coarsest?: number;
  /** Called after each picture. */
  told: (told: Told) => void;
  failed: (message: string) => void;
  /** Called when one has come to rest, before the picture becomes finer. */
  rested: () => void;
  /** Called when `done` has changed. */
  stated: () => void;
}

export function painting(
  canvas: HTMLCanvasElement,
  session: Scenery,
  { off, shown, coarsest = Number.POSITIVE_INFINITY, told, failed, rested, stated }: Options,
): Painting {
  const paper = canvas.getContext("2d", { alpha: false, willReadFrequently: context().software });
  const fade = fading(paper);
  const left = off ?? (() => []);
  let [timer, frame] = [0, 0];
  let factor: number = context().software ? 4 : 1;
  let last: Pixels | null = null;
  let held: { near: Held; far: Held } | null = null;
  const rates = new Map<string, number>();
  let done = false;
  let turn = 0; // counts what was begun: what belongs to an earlier one is over

  const attempt = (act: () => void) => {
    try {
      act();
    } catch (error) {
      if (!context().lost) failed(error instanceof Error ? error.message : String(error));
    }
  };
  const able = () => !!paper && canvas.width > 1 && session.drawable && !context().lost;
  /** The sun's views: each of a while ago does as long as one is near to where it was taken. */
  const sunHeld = (pixels: Pixels): Sunlight | undefined => {
    const { head, place, hour, light } = session;
    if (!head) return undefined;
    if (session.sun) return session.sun();
    const [x, y, z, yaw] = place;
    const fits = (own: Held | undefined, k: 0 | 1, turns: boolean) =>
      own?.hour === hour &&
      Math.hypot(x - own.eye[0], y - own.eye[1], z - own.eye[2]) <= HELD * own.sun.texels[k] * head.sunlight.side &&
      !(turns && Math.abs(((yaw - own.yaw + 540) % 360) - 180) > 25);
    const [near, far] = [fits(held?.near, 0, true), fits(held?.far, 1, false)];
    if (!held || !near || !far) {
      const sun = sunlightOf(light.towards as Vector, frustumOf(place, pixels), head.box, head.sunlight);
      const now: Held = { sun, eye: [x, y, z], yaw, hour };
      held = { near: held && near ? held.near : now, far: held && far ? held.far : now };
    }
    const [a, b] = [held.near.sun, held.far.sun];
    return { near: a.near, far: b.far, texels: [a.texels[0], b.texels[1]] };
  };
  const show = (passes: Pass[], pixels: Pixels): boolean => {
    const [name, how] = shown?.() ?? [passes.at(-1)?.writes[0], undefined];
    if (!paper || !name || !session.pipeline?.show(name, pixels, paper, how)) return false;
    last = pixels;
    return true;
  };
  /** What a pass draws of the mesh in motion; the maps of shadows, which are kept, are drawn as a whole. */
  const drawn = (pass: Pass, values: Values, pixels: Pixels): Pixels[] => {
    const map = pass.writes.some((name) => session.pipeline?.buffer(name).side);
    return session.runs(values[pass.through] as Float64Array, map ? undefined : pixels);
  };
  /** The whole picture at once. */
  const rough = () => {
    const { pipeline } = session;
    if (!pipeline || !able()) return;
    if (!pipeline.ready()) {
      clearTimeout(timer);
      timer = window.setTimeout(redraw, 60);
      return;
    }
    const pixels = pixelsOf(canvas, factor);
    const began = performance.now();
    const values = session.values(pixels, left(), undefined, sunHeld(pixels));
    const passes = session.passes(left());
    for (const pass of passes) {
      if (pass.draws === "screen") pipeline.run(pass, values, pixels);
      else if (!pipeline.fresh(pass, values)) pipeline.run(pass, values, pixels, { runs: drawn(pass, values, pixels) });
    }
    if (!show(passes, pixels)) return;
    const milliseconds = performance.now() - began;
    mark(canvas, "data-coarse", String(factor));
    told({ milliseconds, pixels, factor, spent: new Map() });
    factor = Math.min(coarsest, coarser(factor, milliseconds));
  };
  /** The pieces of a finer picture. */
  function* pieces(fine: number): Generator<void> {
    const { pipeline } = session;
    if (!pipeline) return;
    const pixels = pixelsOf(canvas, fine);
    const values = session.values(pixels, left());
    held = null;
    const passes = session.passes(left());
    const began = performance.now();
    const spent = new Map<string, number>();
    for (const pass of passes) {
      const add = (since: number) => spent.set(pass.name, (spent.get(pass.name) ?? 0) + performance.now() - since);
      if (pass.draws === "mesh") {
        if (!pipeline.fresh(pass, values)) yield* meshed(pass, values, pixels, add);
        continue;
      }
      const height = pipeline.sizeOf(pipeline.buffer(pass.writes[0] as string), pixels)[1];
      for (let low = 0; low < height; ) {
        const rate = rates.get(pass.name) ?? Math.max(4, Math.floor(8000 / pixels[0]));
        const high = Math.min(height, low + rate);
        const start = performance.now();
        pipeline.run(pass, values, pixels, { rows: [low, high] });
        pipeline.finish();
        add(start);
        rates.set(pass.name, rowsFor(BUDGET * 0.8, high - low, performance.now() - start));
        low = high;
        yield;
      }
    }
    if (!show(passes, pixels)) return;
    mark(canvas, "data-coarse", String(fine));
    told({ milliseconds: performance.now() - began, pixels, factor: fine, spent });
  }
  function* meshed(pass: Pass, values: Values, pixels: Pixels, add: (since: number) => void): Generator<void> {
    const { pipeline } = session;
    const runs = session.runs(values[pass.through] as Float64Array);
    let first = true;
    while (first || runs.length) {
      let room = rates.get(pass.name) ?? INDICES;
      const own: Pixels[] = [];
      while (runs.length && room > 0) {
        const [begin, count] = runs[0] as Pixels;
        const taken = Math.min(count, room - (room % 3) || 3);
        own.push([begin, taken]);
        room -= taken;
        if (taken < count) runs[0] = [begin + taken, count - taken];
        else runs.shift();
      }
      const start = performance.now();
      pipeline?.run(pass, values, pixels, { runs: own, first, last: !runs.length });
      pipeline?.finish();
      add(start);
      const drawn = own.reduce((sum, [, count]) => sum + count, 0);
      const spent = Math.max(performance.now() - start, 1);
      if (drawn) rates.set(pass.name, Math.max(3000, Math.min(4 * drawn, Math.round((drawn * BUDGET * 0.8) / spent))));
      first = false;
      yield;
    }
  }
  const refine = (softly = false) =>
    attempt(() => {
      const own = turn;
      rested();
      if (softly) fade.keep();
      if (!able() || !session.pipeline?.ready()) return;
      const steps = softly ? [1] : [...new Set([factor > 3 ? 3 : 1, 1])].filter((fine) => fine < factor || fine === 1);
      const work = (function* () {
        for (const fine of steps) yield* pieces(fine);
      })();
      const next = () =>
        attempt(() => {
          if (context().lost || own !== turn) return;
          const start = performance.now();
          let over = false;
          while (!over && performance.now() - start < BUDGET / 3) over = !!work.next().done;
          if (!over) timer = window.setTimeout(next, 0);
          else if (last && softly) fade.begin(() => own === turn && state(true));
          else if (last) state(true);
        });
      next();
    });
  const state = (now: boolean) => {
    done = now;
    stated();
  };
  const begin = (softly: boolean) => {
    clearTimeout(timer);
    fade.stop();
    timer = window.setTimeout(() => refine(softly), RESTED);
    turn += 1;
    state(false);
  };
  const redraw = () => {
    begin(false);
    if (frame) return;
    frame = requestAnimationFrame(() => {
      frame = 0;
      attempt(rough);
    });
  };
  return {
    redraw,
    refresh() {
      if (done) begin(true);
      else redraw();
    },
    stop() {
      clearTimeout(timer);
      fade.stop();
      cancelAnimationFrame(frame);
    },
    get last() {
      return last;
    },
    get done() {
      return done;
    },
  };
}
