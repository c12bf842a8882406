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

/** Where one is at a time: on a smooth curve through the places, which holds at its ends. */
export function along(path: Stop[], time: number): Place | null {
  const [first, last] = [path[0], path.at(-1)];
  if (!first || !last) return null;
  if (path.length === 1 || time <= 0) return placeOf(first);
  if (time >= last.time) return placeOf(last);
  const k = path.findLastIndex((stop) => stop.time <= time);
  const [from, to] = [path[k] as Stop, path[k + 1] as Stop];
  const t = (time - from.time) / (to.time - from.time);
  const rows = [-1, 0, 1, 2].map((d) => placeOf(path[Math.min(Math.max(k + d, 0), path.length - 1)] as Stop));
  for (let i = 1; i < 4; i += 1) {
    const [before, after] = [rows[i - 1] as Place, rows[i] as Place];
    after[3] = before[3] + mod(after[3] - before[3] + 180, 360) - 180; // the shorter way around
  }
  const [a, b, c, d] = rows as [Place, Place, Place, Place];
  return b.map((own, i) => {
    const [p, q, r] = [a[i] as number, c[i] as number, d[i] as number];
    return own + 0.5 * t * (q - p + t * (2 * p - 5 * own + 4 * q - r + t * (3 * (own - q) + r - p)));
  }) as Place;
}

const mod = (value: number, by: number): number => ((value % by) + by) % by;
