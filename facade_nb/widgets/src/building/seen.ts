// Which triangle is seen at each pixel: drawn here, without the graphics card, so that what is pointed at is known at once
// and the outline of a shape is that of the part of it that is seen.

import type { Matrix } from "./types.ts";

export interface Seen {
  width: number;
  height: number;
  /** Number of the triangle at each pixel, row 0 at the top; -1: none. */
  triangle: Int32Array;
  /** 1 / how deep it lies. */
  near: Float32Array;
}

const NEAR = 0.05; // metres before the eye at which triangles are cut off

/** `corners`: 9 numbers of each triangle; `camera`: from the world to clip space. What is seen from behind is left out. */
export function seenBy(corners: Float32Array, camera: Matrix, width: number, height: number, before?: Seen): Seen {
  const same = before?.width === width && before.height === height;
  const found: Seen = same
    ? before
    : { width, height, triangle: new Int32Array(width * height), near: new Float32Array(width * height) };
  found.triangle.fill(-1);
  found.near.fill(0);
  const clip = new Float64Array(12); // x, y, w of up to four corners
  const cut = new Float64Array(12);
  const m = camera as ArrayLike<number> as number[];
  const count = corners.length / 9;
  for (let t = 0; t < count; t += 1) {
    let behind = 0;
    for (let k = 0; k < 3; k += 1) {
      const at = 9 * t + 3 * k;
      const [x, y, z] = [corners[at] as number, corners[at + 1] as number, corners[at + 2] as number];
      const w = (m[12] as number) * x + (m[13] as number) * y + (m[14] as number) * z + (m[15] as number);
      clip[3 * k] = (m[0] as number) * x + (m[1] as number) * y + (m[2] as number) * z + (m[3] as number);
      clip[3 * k + 1] = (m[4] as number) * x + (m[5] as number) * y + (m[6] as number) * z + (m[7] as number);
      clip[3 * k + 2] = w;
      if (w < NEAR) behind += 1;
    }
    if (behind === 3) continue;
    if (behind === 0) fill(found, clip, 0, 1, 2, t);
    else {
      const sides = cutOff(clip, cut);
      for (let k = 2; k < sides; k += 1) fill(found, cut, 0, k - 1, k, t);
    }
  }
  return found;
}

/** The part of a triangle before the eye, a polygon; returns how many corners it has. */
function cutOff(from: Float64Array, to: Float64Array): number {
  let count = 0;
  for (let k = 0; k < 3; k += 1) {
    const [a, b] = [3 * k, 3 * ((k + 1) % 3)];
    const [w0, w1] = [from[a + 2] as number, from[b + 2] as number];
    if (w0 >= NEAR) {
      for (let i = 0; i < 3; i += 1) to[3 * count + i] = from[a + i] as number;
      count += 1;
    }
    if (w0 >= NEAR !== w1 >= NEAR) {
      const part = (NEAR - w0) / (w1 - w0);
      for (let i = 0; i < 3; i += 1)
        to[3 * count + i] = (from[a + i] as number) + part * ((from[b + i] as number) - (from[a + i] as number));
      count += 1;
    }
  }
  return count;
}

function fill({ width, height, triangle, near }: Seen, own: Float64Array, i: number, j: number, k: number, t: number) {
  const [ai, aj, ak] = [1 / (own[3 * i + 2] as number), 1 / (own[3 * j + 2] as number), 1 / (own[3 * k + 2] as number)];
  const x0 = (0.5 + 0.5 * (own[3 * i] as number) * ai) * width - 0.5;
  const y0 = (0.5 - 0.5 * (own[3 * i + 1] as number) * ai) * height - 0.5;
  const x1 = (0.5 + 0.5 * (own[3 * j] as number) * aj) * width - 0.5;
  const y1 = (0.5 - 0.5 * (own[3 * j + 1] as number) * aj) * height - 0.5;
  const x2 = (0.5 + 0.5 * (own[3 * k] as number) * ak) * width - 0.5;
  const y2 = (0.5 - 0.5 * (own[3 * k + 1] as number) * ak) * height - 0.5;
  const area = (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0);
  if (area >= 0) return; // rows grow downwards: a front is seen clockwise
  const top = Math.max(0, Math.ceil(Math.min(y0, y1, y2)));
  const low = Math.min(height - 1, Math.floor(Math.max(y0, y1, y2)));
  const left = Math.max(0, Math.ceil(Math.min(x0, x1, x2)));
  const right = Math.min(width - 1, Math.floor(Math.max(x0, x1, x2)));
  if (top > low || left > right) return;
  const by = 1 / area;
  // How much of each corner a pixel has changes by as much from pixel to pixel.
  const [ux, vx] = [(y1 - y2) * by, (y2 - y0) * by];
  for (let y = top; y <= low; y += 1) {
    let u = ((x1 - left) * (y2 - y) - (y1 - y) * (x2 - left)) * by;
    let v = ((x2 - left) * (y0 - y) - (y2 - y) * (x0 - left)) * by;
    for (let x = left, at = y * width + left; x <= right; x += 1, at += 1, u += ux, v += vx) {
      const rest = 1 - u - v;
      if (u < -1e-9 || v < -1e-9 || rest < -1e-9) continue;
      const own_near = u * ai + v * aj + rest * ak;
      if (own_near <= (near[at] as number)) continue;
      near[at] = own_near;
      triangle[at] = t;
    }
  }
}

/** The triangle that a ray meets first, from its front, and how far along; null: none. */
export function met(
  corners: Float32Array,
  [ex, ey, ez]: readonly number[],
  [rx, ry, rz]: readonly number[],
): { triangle: number; far: number } | null {
  const c = corners as ArrayLike<number> as number[];
  const [dx, dy, dz] = [rx as number, ry as number, rz as number];
  let best = -1;
  let far = Number.POSITIVE_INFINITY;
  for (let at = 0; at < corners.length; at += 9) {
    const [ax, ay, az] = [c[at] as number, c[at + 1] as number, c[at + 2] as number];
    const [ux, uy, uz] = [(c[at + 3] as number) - ax, (c[at + 4] as number) - ay, (c[at + 5] as number) - az];
    const [vx, vy, vz] = [(c[at + 6] as number) - ax, (c[at + 7] as number) - ay, (c[at + 8] as number) - az];
    const [px, py, pz] = [dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx];
    const det = ux * px + uy * py + uz * pz;
    if (det < 1e-12) continue;
    const [ox, oy, oz] = [(ex as number) - ax, (ey as number) - ay, (ez as number) - az];
    const u = ox * px + oy * py + oz * pz;
    if (u < 0 || u > det) continue;
    const [qx, qy, qz] = [oy * uz - oz * uy, oz * ux - ox * uz, ox * uy - oy * ux];
    const v = dx * qx + dy * qy + dz * qz;
    if (v < 0 || u + v > det) continue;
    const own = (vx * qx + vy * qy + vz * qz) / det;
    if (own <= 1e-6 || own >= far) continue;
    far = own;
    best = at / 9;
  }
  return best < 0 ? null : { triangle: best, far };
}
