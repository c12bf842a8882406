// How a building is looked at: the eye goes around a point of it. Where that is, and what a pixel looks along.

import { type Frustum, type Matrix, matrixOf } from "../pipeline/camera.ts";
import { frustumOf } from "../town/frame.ts";
import type { Place } from "../town/types.ts";
import type { Pixels, Vector } from "./types.ts";

export const ANGLE = 36; // degrees across
const RADIAN = Math.PI / 180;
const FILLS = 0.86; // of the picture, by what is looked at as a whole
const LOWEST = 0.25; // metres above the ground

export interface Look {
  turn: number;
  rise: number;
  /** 0: as far as the building fills the view. */
  distance: number;
  /** null: the middle of the building. */
  target: Vector | null;
}

/** From where it is looked at first; from there it fills the view. */
export const FIRST = { turn: 24, rise: 0 };

type Direction = Pick<Look, "turn" | "rise">;

/** The middle of a box: least and greatest coordinates. */
export const middleOf = (box: number[]): Vector =>
  [0, 1, 2].map((k) => ((box[k] as number) + (box[k + 3] as number)) / 2) as Vector;

export const targetOf = (look: Look, box: number[]): Vector => look.target ?? middleOf(box);

/** Unit vector from the target to the eye. */
function outward({ turn, rise }: Direction): Vector {
  const [t, r] = [turn * RADIAN, rise * RADIAN];
  return [Math.sin(t) * Math.cos(r), Math.sin(r), Math.cos(t) * Math.cos(r)];
}

/** From how far a box fills a view that is `aspect` times as wide as high. */
export function distanceOf(look: Look, box: number[], aspect: number): number {
  if (look.distance) return look.distance;
  const out = outward(FIRST);
  const [right, up] = axesOf(FIRST);
  const middle = middleOf(box);
  const wide = FILLS * Math.tan((ANGLE / 2) * RADIAN);
  let most = 0.5;
  for (let k = 0; k < 8; k += 1) {
    const off = middle.map((at, axis) => (box[k & (1 << axis) ? axis + 3 : axis] as number) - at) as Vector;
    const along = (axis: Vector) => off[0] * axis[0] + off[1] * axis[1] + off[2] * axis[2];
    const needed = Math.max(Math.abs(along(right)) / wide, (Math.abs(along(up)) * aspect) / wide);
    most = Math.max(most, needed + along(out));
  }
  return most;
}

/** To the right and up in the picture. */
export function axesOf({ turn, rise }: Direction): [right: Vector, up: Vector] {
  const [t, r] = [turn * RADIAN, rise * RADIAN];
  return [
    [Math.cos(t), 0, -Math.sin(t)],
    [-Math.sin(t) * Math.sin(r), Math.cos(r), -Math.cos(t) * Math.sin(r)],
  ];
}

/** Where the eye is, never in the ground. */
export function placeOf(look: Look, box: number[], aspect: number): Place {
  const target = targetOf(look, box);
  const distance = distanceOf(look, box, aspect);
  const out = outward(look);
  const eye = target.map((at, k) => at + distance * (out[k] as number)) as Vector;
  const lowest = Math.min(LOWEST, Math.max(0.02, target[1]));
  let { rise } = look;
  if (eye[1] < lowest) {
    eye[1] = lowest;
    rise = Math.atan2(eye[1] - target[1], Math.hypot(eye[0] - target[0], eye[2] - target[2])) / RADIAN;
  }
  return [...eye, -look.turn, -rise, ANGLE];
}

/** The eye, and the direction in which a place of the picture (0 to 1 from its lower left) is seen; one metre deep. */
export function rayOf(place: Place, pixels: Pixels, across: number, up: number): { eye: Vector; ray: Vector } {
  const frustum: Frustum = frustumOf(place, pixels);
  const [left, bottom, right, top] = frustum.window;
  const [x, y] = [left + across * (right - left), bottom + up * (top - bottom)];
  const ray = frustum.ahead.map(
    (own, k) => own + x * (frustum.right[k] as number) + y * (frustum.up[k] as number),
  ) as Vector;
  return { eye: frustum.eye, ray };
}

/** From the world to the picture, as passes are told. */
export const cameraOf = (place: Place, pixels: Pixels): Matrix => matrixOf(frustumOf(place, pixels));
