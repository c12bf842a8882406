// How a façade is looked at (Python: render/texture/view.py, widgets/texture/view.py): pixels to rays and back.

import type { Pair, Triple } from "./types.ts";

const ANGLE = 50;
const HALF = Math.tan((ANGLE / 2) * (Math.PI / 180));

export interface Look {
  turn: number;
  rise: number;
  /** 0: as far as the façade fills the view. */
  distance: number;
  /** null: the middle of the façade. */
  target: Pair | null;
  flat: boolean;
}

export interface Sight {
  window: [number, number, number, number];
  eye: Triple | null;
  right: Triple;
  ahead: Triple;
}

export function targetOf(look: Look, size: Pair): Pair {
  return look.target ?? [size[0] / 2, size[1] / 2];
}

export function distanceOf(look: Look, size: Pair, aspect: number): number {
  return look.distance || ((look.flat ? 1.04 : 1.35) * Math.max(size[0], size[1] * aspect)) / 2 / HALF;
}

/** The sight of a picture `aspect` times as wide as high. */
export function sightOf(look: Look, size: Pair, aspect: number): Sight {
  const [x, y] = targetOf(look, size);
  const distance = distanceOf(look, size, aspect);
  if (look.flat) {
    const wide = distance * HALF;
    const tall = wide / aspect;
    return { window: [x - wide, y - tall, x + wide, y + tall], eye: null, right: [1, 0, 0], ahead: [0, 0, -1] };
  }
  const turn = (look.turn * Math.PI) / 180;
  const rise = (look.rise * Math.PI) / 180;
  const off: Triple = [
    distance * Math.sin(turn) * Math.cos(rise),
    distance * Math.sin(rise),
    distance * Math.cos(turn) * Math.cos(rise),
  ];
  const reach = Math.hypot(off[0], off[2]);
  const ahead: Triple = [-off[0] / reach, 0, -off[2] / reach];
  const up = -off[1] / reach;
  const tall = HALF / aspect;
  return {
    window: [-HALF, up - tall, HALF, up + tall],
    eye: [x + off[0], y + off[1], off[2]],
    right: [-ahead[2], 0, ahead[0]],
    ahead,
  };
}

/** The point of the façade's plane at a place of the picture (0 to 1 from its upper left), and the ray to it. */
export function meet(sight: Sight, across: number, down: number): { point: Pair; ray: Triple | null } | null {
  const [left, bottom, right, top] = sight.window;
  const u = left + across * (right - left);
  const v = bottom + (1 - down) * (top - bottom);
  const { eye } = sight;
  if (!eye) return { point: [u, v], ray: null };
  const ray: Triple = [u * sight.right[0] + sight.ahead[0], v, u * sight.right[2] + sight.ahead[2]];
  if (ray[2] > -1e-6) return null;
  const reach = eye[2] / -ray[2];
  return { point: [eye[0] + ray[0] * reach, eye[1] + ray[1] * reach], ray };
}

const NEAR = 1e-3; // metres in front of the eye

/** How far ahead of the eye a place is, and where it stands across and up, times that; 1 where there is no eye. */
function seen({ eye, right, ahead }: Sight, [x, y, z]: Triple): Triple {
  if (!eye) return [x, y, 1];
  const [dx, dy, dz] = [x - eye[0], y - eye[1], z - eye[2]];
  return [dx * right[0] + dz * right[2], dy, dx * ahead[0] + dz * ahead[2]];
}

function placed({ window: [left, bottom, right, top] }: Sight, [u, v, depth]: Triple): Pair {
  return [(u / depth - left) / (right - left), 1 - (v / depth - bottom) / (top - bottom)];
}

/** Where a place stands in the picture (0 to 1 from its upper left); null behind the eye. */
export function project(sight: Sight, place: Triple): Pair | null {
  const found = seen(sight, place);
  return found[2] < NEAR ? null : placed(sight, found);
}

/** As `project`, of a polygon: what is behind the eye is cut off. */
export function outline(sight: Sight, corners: Triple[]): Pair[] {
  const found = corners.map((corner) => seen(sight, corner));
  return found.flatMap((at, k) => {
    const before = found[(k + found.length - 1) % found.length] as Triple;
    const kept: Pair[] = [];
    if (at[2] < NEAR !== before[2] < NEAR) {
      const part = (NEAR - before[2]) / (at[2] - before[2]);
      const cut = before.map((value, i) => value + part * ((at[i] as number) - value)) as Triple;
      kept.push(placed(sight, cut));
    }
    if (at[2] >= NEAR) kept.push(placed(sight, at));
    return kept;
  });
}
