// Ways through the town (Python: CameraPath).

import type { Place, Stop } from "./types.ts";

export const placeOf = ({ eye, yaw, pitch, angle }: Stop): Place => [...eye, yaw, pitch, angle];
export const stopOf = (time: number, [x, y, z, yaw, pitch, angle]: Place): Stop => ({
  time,
  eye: [x, y, z],
  yaw,
  pitch,
  angle,
});

/** Seconds that a path takes. */
export const secondsOf = (path: Stop[]): number => path.at(-1)?.time ?? 0;

/** Where one is at a time, on a smooth curve through the places that does not swing beyond any two of them. */
export function along(path: Stop[], time: number): Place | null {
  const [first, last] = [path[0], path.at(-1)];
  if (!first || !last) return null;
  if (path.length === 1 || time <= 0) return placeOf(first);
  if (time >= last.time) return placeOf(last);
  const k = path.findLastIndex((stop) => stop.time <= time);
  const four = [-1, 0, 1, 2].map((d) => path[Math.min(Math.max(k + d, 0), path.length - 1)] as Stop);
  const times = four.map((stop) => stop.time);
  const rows = four.map(placeOf);
  for (let i = 1; i < 4; i += 1) {
    const [before, after] = [rows[i - 1] as Place, rows[i] as Place];
    after[3] = before[3] + mod(after[3] - before[3] + 180, 360) - 180; // the shorter way around
  }
  return placeOf(four[1] as Stop).map((_, c) =>
    between(
      times,
      rows.map((row) => row[c] as number),
      time,
    ),
  ) as Place;
}

/** A cubic between the middle two of four values, monotone where they are (Fritsch and Butland's slopes). */
function between(times: number[], values: number[], time: number): number {
  const [t0, t1, t2, t3] = times as [number, number, number, number];
  const [a, b, c, d] = values as [number, number, number, number];
  const step = t2 - t1;
  const rise = (c - b) / step;
  const [first, last] = [slope(t1 - t0, step, b - a, rise), slope(t3 - t2, step, d - c, rise)];
  const t = (time - t1) / step;
  const rest = 1 - t;
  return b * rest * rest * (1 + 2 * t) + c * t * t * (1 + 2 * rest) + step * t * rest * (first * rest - last * t);
}

/** At a place, from what lies beyond it: so many seconds, and so large a change. */
function slope(beyond: number, step: number, change: number, rise: number): number {
  if (beyond <= 0) return 0; // an end: one starts and stops gently
  const other = change / beyond;
  if (other * rise <= 0) return 0;
  const [near, far] = [2 * step + beyond, step + 2 * beyond];
  return (near + far) / (near / other + far / rise);
}

const mod = (value: number, by: number): number => ((value % by) + by) % by;
