// Draws façades with the pipeline: each a rectangle that its passes see, in the page's one context. Views copy their pictures
// from there.

import { cameraValues, type Frustum } from "../pipeline/camera.ts";
import { context } from "../pipeline/context.ts";
import { Pipeline, type Source } from "../pipeline/pipeline.ts";
import type { Pass, Values } from "../pipeline/types.ts";
import { noiseBytes } from "../shared/noise.ts";
import type { Sight } from "./sight.ts";
import type { Common, Light, Pair, Scene, Tiles } from "./types.ts";

export interface Job {
  /** Whose picture it is: what was made for it is kept until `release`. */
  owner: object;
  common: Common;
  scene: Scene;
  tiles: Tiles;
  sight: Sight;
  size: Pair;
  seed: Pair;
  /** The light; null: colours as they are. */
  light: Light | null;
}

/** A seed in metres as whole steps of 1/64 m, wrapped to 32 bits, and what is left (Python: noise.py). */
export function seedOf(seed: Pair): { whole: Pair; rest: Pair } {
  const whole = seed.map((value) => Math.floor(value * 64)) as Pair;
  return {
    whole: whole.map((value) => ((value % 2 ** 32) + 2 ** 32) % 2 ** 32) as Pair,
    rest: seed.map((value, k) => value * 64 - (whole[k] as number)) as Pair,
  };
}

/** The table of one seed (Python: uploads.py, `seeds_upload`). */
export function seedTable(seed: Pair): Float32Array {
  const { whole, rest } = seedOf(seed);
  const halves = whole.flatMap((value) => [Math.floor(value / 65536), value % 65536]);
  return Float32Array.from([...halves, ...rest, 0, 0]);
}

/** The corners of a façade's rectangle, which goes on beyond its ends (Python: render/pipeline/facade.py, `alone`). */
export function cornersOf(size: Pair, start: Pair): Float32Array {
  const rim = Math.max(...size);
  const [left, bottom, right, top] = [-rim, -rim, size[0] + rim, size[1] + rim];
  const places: Pair[] = [
    [left, bottom],
    [right, bottom],
    [right, top],
    [left, top],
  ];
  return Float32Array.from(places.flatMap((at) => [...at, 0, ...at, ...size, ...start, 0, 0, 0, 0, 1, 1, 0, 0]));
}

/** The camera of a sight (Python: `Frustum.of_sight`). */
export function frustumOf({ eye, right, ahead, window }: Sight): Frustum {
  const camera = { right, up: [0, 1, 0] as [number, number, number], ahead, window };
  if (!eye) return { ...camera, eye: [0, 0, 1], reach: [0.5, 2], parallel: true };
  return { ...camera, eye, reach: [(0.5 * eye[2]) / (1 + Math.max(...window.map(Math.abs))), 1e9] };
}

const INDICES = new Uint8Array(Uint32Array.of(0, 1, 2, 0, 2, 3).buffer);
const bytesOf = (values: Float32Array | Uint8Array) =>
  new Uint8Array(values.buffer, values.byteOffset, values.byteLength);

interface Made {
  pipeline: Pipeline;
  scene: Scene;
  tiles: Tiles;
  corners: Uint8Array;
  seeds: Uint8Array;
  size: Pair;
  seed: Pair;
}

const made = new WeakMap<object, Made>();

function sourceOf({ common, scene, tiles }: Job, corners: Uint8Array, seeds: Uint8Array): Source {
  const texels = (wide: number, tall: number) => [wide, tall] as [number, number];
  const grammar = {
    size: texels(scene.width, scene.height),
    channels: 4,
    kind: scene.bits === 16 ? "f2" : "f4",
  } as const;
  return {
    passes: common.passes,
    buffers: common.buffers,
    shaders: { ...common.shaders, ...scene.shaders },
    stride: common.stride,
    attributes: common.attributes,
    vertices: corners,
    indices: INDICES,
    textures: {
      grammar: { image: grammar, content: scene.texture },
      noise: { image: { size: texels(256, 256), channels: 1, kind: "f4" }, content: noiseBytes() },
      atlas: { image: { size: texels(tiles.width, tiles.height), channels: 4, kind: "f1" }, content: tiles.pixels },
      tile_table: {
        image: { size: texels(tiles.levels, tiles.count), channels: 4, kind: "f4" },
        content: own(tiles.table),
      },
      seeds: { image: { size: [2, 1], channels: 4, kind: "f4" }, content: seeds },
    },
  };
}

const views = new WeakMap<object, Uint8Array>();

/** Always the same bytes of the same values: what has not changed is not sent to the card again. */
function own(values: Float32Array): Uint8Array {
  let found = views.get(values);
  if (!found) {
    found = bytesOf(values);
    views.set(values, found);
  }
  return found;
}

/** What was made for a picture, brought up to date. */
function ready(job: Job): Pipeline {
  const { owner, scene, tiles, size, seed } = job;
  let found = made.get(owner);
  if (!found) {
    const corners = bytesOf(cornersOf(size, scene.start));
    const seeds = bytesOf(seedTable(seed));
    found = { pipeline: new Pipeline(sourceOf(job, corners, seeds)), scene, tiles, corners, seeds, size, seed };
    made.set(owner, found);
    return found.pipeline;
  }
  const { pipeline, corners, seeds } = found;
  const other = found.scene !== scene || found.tiles !== tiles;
  if (other) pipeline.replace(sourceOf(job, corners, seeds));
  if (other || String(found.size) !== String(size)) {
    corners.set(bytesOf(cornersOf(size, scene.start)));
    pipeline.changed("vertices");
  }
  if (String(found.seed) !== String(seed)) {
    seeds.set(bytesOf(seedTable(seed)));
    pipeline.changed("seeds");
  }
  Object.assign(found, { scene, tiles, size, seed });
  return pipeline;
}

/** Those that make this picture, in their order. */
function passesOf({ common, light }: Job, how: "sharp" | "smooth"): Pass[] {
  return common.passes.filter(({ when }) => when === "" || when === how || (when === "lit" && light !== null));
}

/** Whether the shaders of the smooth picture are there; if not, they are on their way, which does not stall the page. */
export function smoothReady(job: Job): boolean {
  if (context().lost) return true;
  return ready(job).ready(passesOf(job, "smooth"));
}

/**
 * Draw the rows from `low` to `high`, from the bottom, of a picture, and copy them, stretched over the same part of `to`;
 * with more samples at boundaries if it is to be smooth. Returns false while the context is lost.
 */
export function draw(
  job: Job,
  to: CanvasRenderingContext2D,
  width: number,
  height: number,
  low = 0,
  high = height,
  smooth = false,
): boolean {
  context().get();
  if (context().lost) return false;
  const pipeline = ready(job);
  const pixels: Pair = [width, height];
  const values: Values = { ...job.light, ...cameraValues(frustumOf(job.sight), pixels) };
  for (const pass of passesOf(job, smooth ? "smooth" : "sharp"))
    pipeline.run(pass, values, pixels, { rows: [low, high], runs: [[0, 6]] });
  return pipeline.show(job.light ? "toned" : "color", pixels, to, { mode: job.light ? 6 : 0 }, [low, high]);
}

/** Drop what was made for a picture. */
export function release(owner: object): void {
  made.get(owner)?.pipeline.free();
  made.delete(owner);
}

/** Be told when a lost context has come back; until the signal ends. */
export function watch(redraw: () => void, signal: AbortSignal): void {
  context().watch((lost) => {
    if (!lost) redraw();
  }, signal);
}
