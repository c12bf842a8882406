// Cameras, and the light of an hour, as shaders are told of them (Python: render/pipeline/viewpoint.py, frame.py).

import type { Pixels, Values } from "./types.ts";

export type Vector = [number, number, number];
export type Matrix = Float64Array; // 4 × 4, row by row

export interface Frustum {
  eye: Vector;
  right: Vector;
  up: Vector;
  ahead: Vector;
  window: [left: number, bottom: number, right: number, top: number];
  reach: [near: number, far: number];
  /** Whether all rays run straight ahead, from the window's points. */
  parallel?: boolean;
}

export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** From the world to clip space. */
export function matrixOf({ eye, right, up, ahead, window: [l, b, r, t], reach: [n, f], parallel }: Frustum): Matrix {
  const view = [right, up, ahead].map((axis) => [...axis, -dot(axis, eye)]);
  view.push([0, 0, 0, 1]);
  const lens = parallel
    ? [
        [2 / (r - l), 0, 0, -(r + l) / (r - l)],
        [0, 2 / (t - b), 0, -(t + b) / (t - b)],
        [0, 0, 2 / (f - n), -(f + n) / (f - n)],
        [0, 0, 0, 1],
      ]
    : [
        [2 / (r - l), 0, -(r + l) / (r - l), 0],
        [0, 2 / (t - b), -(t + b) / (t - b), 0],
        [0, 0, (f + n) / (f - n), (-2 * f * n) / (f - n)],
        [0, 0, 1, 0],
      ];
  const made = new Float64Array(16);
  for (let i = 0; i < 4; i += 1)
    for (let j = 0; j < 4; j += 1)
      for (let k = 0; k < 4; k += 1)
        made[4 * i + j] = (made[4 * i + j] as number) + (lens[i]?.[k] as number) * (view[k]?.[j] as number);
  return made;
}

/** What shaders are told of a camera. */
export function cameraValues(frustum: Frustum, [width, height]: Pixels): Values {
  const [left, bottom, right, top] = frustum.window;
  return {
    camera: matrixOf(frustum),
    eye: frustum.eye,
    across: frustum.right,
    upward: frustum.up,
    forward: frustum.ahead,
    window: [left, bottom, (right - left) / width, (top - bottom) / height],
    parallel: Number(frustum.parallel ?? false),
  };
}

export type Light = Record<string, number | number[]>;

/** The light of an hour, between those that Python has told. */
export function lightAt(hours: Light[], hour: number): Light {
  const at = Math.min(Math.max(hour / 24, 0), 1) * (hours.length - 1);
  const low = hours[Math.floor(at)] as Light;
  const high = hours[Math.ceil(at)] as Light;
  const part = at - Math.floor(at);
  const mix = (a: number, b: number) => a + (b - a) * part;
  return Object.fromEntries(
    Object.entries(low).map(([name, value]) => {
      const other = high[name];
      return [
        name,
        Array.isArray(value)
          ? value.map((own, k) => mix(own, (other as number[])[k] as number))
          : mix(value, other as number),
      ];
    }),
  );
}
