// What shaders are told of one picture, as Python has it (render/pipeline/frame.py, viewpoint.py, sunlight.py).

import { cameraValues, dot, type Frustum, lightAt, type Matrix } from "../pipeline/camera.ts";
import type { Chunks, Head, Light, Pixels, Place, Values, Vector } from "./types.ts";

export { dot, type Frustum, type Matrix, matrixOf } from "../pipeline/camera.ts";

const RADIAN = Math.PI / 180;

const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** What is seen from a place through pixels as high as wide. */
export function frustumOf([x, y, z, turned, raised, angle]: Place, [width, height]: Pixels): Frustum {
  const [yaw, pitch] = [turned * RADIAN, raised * RADIAN];
  const half = Math.tan((angle * RADIAN) / 2);
  const tall = (half * height) / width;
  return {
    eye: [x, y, z],
    right: [Math.cos(yaw), 0, Math.sin(yaw)],
    up: [-Math.sin(yaw) * Math.sin(pitch), Math.cos(pitch), Math.cos(yaw) * Math.sin(pitch)],
    ahead: [Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), -Math.cos(yaw) * Math.cos(pitch)],
    window: [-half, -tall, half, tall],
    reach: [Math.min(Math.max(0.06 * y, 0.1), 4), 30_000],
  };
}

/** A part of the picture, in shares of its width and height from its lower left corner. */
export function cropped(frustum: Frustum, left: number, bottom: number, right: number, top: number): Frustum {
  const [l, b, r, t] = frustum.window;
  return {
    ...frustum,
    window: [l + left * (r - l), b + bottom * (t - b), l + right * (r - l), b + top * (t - b)],
  };
}

export interface Sunlight {
  near: Matrix;
  far: Matrix;
  texels: [near: number, far: number];
}

/**
 * The views of the sun, for a direction towards it, a camera, and a scene's box. `around`: the middle of the fine one, where
 * that is not before the camera.
 */
export function sunlightOf(
  towards: Vector,
  frustum: Pick<Frustum, "eye" | "ahead">,
  box: number[],
  own: Head["sunlight"],
  around?: Vector,
): Sunlight {
  const ahead = towards.map((value) => -value) as Vector;
  const level = Math.max(Math.hypot(ahead[0], ahead[2]), 1e-9);
  const right: Vector = [-ahead[2] / level, 0, ahead[0] / level];
  const axes: [Vector, Vector, Vector] = [right, cross(right, ahead), ahead];
  const [low, high] = [box.slice(0, 3), box.slice(3)] as [Vector, Vector];
  const middle = low.map((value, k) => (value + (high[k] as number)) / 2) as Vector;
  const whole = Math.hypot(...low.map((value, k) => (high[k] as number) - value)) / 2 + 1;
  // A map whose size is given does not grow, and then the other one is of all.
  const half = Math.min(own.rise ? stepped(own, frustum.eye[1]) : own.near, own.most, whole);
  const clip = (at: Vector) =>
    at.map((value, k) => Math.min(Math.max(value, low[k] as number), high[k] as number)) as Vector;
  const [ex, , ez] = frustum.eye;
  const spot = clip(around ?? [ex + frustum.ahead[0] * 0.7 * half, 0, ez + frustum.ahead[2] * 0.7 * half]);
  const all = Math.min(whole, own.rise ? Math.min(own.far, own.wider * half) : own.far);
  const centre = all === whole ? middle : clip([ex, 0, ez]);
  return {
    near: parallel(axes, spot, half, low, high, own.side),
    far: parallel(axes, centre, all, low, high, own.side),
    texels: [(2 * half) / own.side, (2 * all) / own.side],
  };
}

/** Half the side of the fine map for an eye at a height: it grows in steps, within which shadows do not swim. */
function stepped({ near, rise, stands, most }: Head["sunlight"], height: number): number {
  const wanted = near + rise * Math.max(height - stands, 0);
  let half = near;
  while (half < Math.min(wanted, most)) half *= Math.SQRT2;
  return half;
}

/** The nearest whole number; of two the even one, as NumPy does. */
function even(value: number): number {
  const low = Math.floor(value);
  const part = value - low;
  return part < 0.5 || (part === 0.5 && low % 2 === 0) ? low : low + 1;
}

function parallel(
  axes: [Vector, Vector, Vector],
  spot: Vector,
  half: number,
  low: Vector,
  high: Vector,
  side: number,
): Matrix {
  let [near, far] = [Infinity, -Infinity];
  for (let k = 0; k < 8; k += 1) {
    const corner = low.map((value, i) => (k & (1 << i) ? (high[i] as number) : value)) as Vector;
    const depth = dot(corner, axes[2]);
    near = Math.min(near, depth);
    far = Math.max(far, depth);
  }
  near -= 1;
  far += 1;
  const texel = (2 * half) / side;
  const [x, y] = [even(dot(axes[0], spot) / texel) * texel, even(dot(axes[1], spot) / texel) * texel];
  const deep = far - near;
  return new Float64Array([
    ...[...axes[0].map((value) => value / half), -x / half],
    ...[...axes[1].map((value) => value / half), -y / half],
    ...[...axes[2].map((value) => (2 * value) / deep), -(far + near) / deep],
    ...[0, 0, 0, 1],
  ]);
}

/** The view of street lamps around the eye: east is right, north up. */
function fromAbove([x, , z]: Vector, { above, each }: Head["sunlight"]): Matrix {
  const [east, south] = [x, z].map((value) => (even(value / each) * each) / above) as [number, number];
  return new Float64Array([1 / above, 0, 0, -east, 0, 0, -1 / above, south, 0, 0, 0, 0, 0, 0, 0, 1]);
}

/** The light of an hour, between those that Python has told. */
export function daylight(hours: Light[], hour: number): Light {
  const light = lightAt(hours, hour);
  const towards = light.towards as Vector;
  const length = Math.hypot(...towards);
  return { ...light, towards: towards.map((value) => value / length) };
}

export interface Looks {
  shadow: boolean;
  occlusion: boolean;
}

/** Values of all shaders. `sun` may be one of another frame: then its maps are those of that frame, too. */
export function uniformsOf(
  head: Pick<Head, "box" | "sunlight" | "looks">,
  frustum: Frustum,
  light: Light,
  pixels: Pixels,
  looks: Looks,
  sun: Sunlight = sunlightOf(light.towards as Vector, frustum, head.box, head.sunlight),
): Values {
  return {
    ...light,
    ...cameraValues(frustum, pixels),
    sun_near: sun.near,
    sun_far: sun.far,
    sun_texel: sun.texels,
    above: fromAbove(frustum.eye, head.sunlight),
    haze: head.looks.haze,
    reach: head.looks.reach,
    shades: [Number(looks.shadow && isDay(light)), Number(looks.occlusion)],
  };
}

/** Whether the sun gives any light. */
export function isDay(light: Light): boolean {
  return (light.sun as number[]).some((value) => value !== 0);
}

/**
 * Runs (first index, count) of the chunks that may be seen through a matrix, and are there; next to one another, one. `some`:
 * how many indices of a chunk are drawn.
 */
export function visible(
  chunks: Chunks,
  through: Matrix,
  there: (chunk: number) => boolean = () => true,
  some: (chunk: number) => number = (chunk) => chunks.count[chunk] as number,
): Pixels[] {
  const planes: number[][] = [];
  for (const sign of [1, -1])
    for (let axis = 0; axis < 3; axis += 1)
      planes.push([0, 1, 2, 3].map((k) => (through[12 + k] as number) + sign * (through[4 * axis + k] as number)));
  planes.length = 5; // nothing is too far
  const runs: Pixels[] = [];
  const { first, low, high } = chunks;
  for (let c = 0; c < first.length; c += 1) {
    const inside = planes.every(([a, b, d, offset]) => {
      const x = ((a as number) > 0 ? high : low)[3 * c] as number;
      const y = ((b as number) > 0 ? high : low)[3 * c + 1] as number;
      const z = ((d as number) > 0 ? high : low)[3 * c + 2] as number;
      return (a as number) * x + (b as number) * y + (d as number) * z + (offset as number) >= 0;
    });
    if (!inside || !there(c)) continue;
    const last = runs.at(-1);
    const own = some(c);
    if (last && last[0] + last[1] === first[c]) last[1] += own;
    else if (own) runs.push([first[c] as number, own]);
  }
  return runs;
}
