// Where nodes and arcs of the Network view lie, and which of them is under a point.

import type { Point } from "./plane.ts";
import type { Arc, Scene } from "./scene.ts";

export const ASPECT = 0.58; // rows are so much closer than columns

export function pointOf(scene: Pick<Scene, "pair">, places: readonly number[]): Point {
  const [a, b] = scene.pair;
  return { x: (places[b] ?? 0) / 2, y: a < 0 ? 0 : ((places[a] ?? 0) / 2) * ASPECT };
}

export function boundsOf(scene: Scene) {
  const [rows, cols] = scene.size;
  // Arcs along the first row bend above it, those along the last column beyond it, at the most by half of their bend.
  const above = bendOf(scene, cols - 1, 0) / 2;
  const beyond = rows > 1 ? bendOf(scene, 0, (rows - 1) * ASPECT) / 2 : 0;
  return {
    left: -0.4,
    right: cols - 1 + Math.max(0.4, beyond + 0.1),
    top: -Math.max(0.25, above + 0.08),
    bottom: (rows - 1) * ASPECT + 0.3,
  };
}

/** How far the point that bends an arc lies beside its chord: longer arcs bend more, but not as much as they are longer. */
function bendOf(scene: Pick<Scene, "size">, dx: number, dy: number): number {
  const length = Math.hypot(dx, dy);
  const flat = dx === 0 || dy === 0;
  const share = scene.size[0] === 1 ? 0.3 : flat ? 0.16 : 0.09;
  return share * (length <= 2 ? length : Math.sqrt(2 * length));
}

/** The curve of an arc: its ends and the point that bends it. */
export function curveOf(scene: Scene, arc: Arc): [Point, Point, Point] {
  const [from, to] = [pointOf(scene, arc.from), pointOf(scene, arc.to)];
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const bend = bendOf(scene, dx, dy) / (Math.hypot(dx, dy) || 1);
  return [from, { x: (from.x + to.x) / 2 + dy * bend, y: (from.y + to.y) / 2 - dx * bend }, to];
}

/** The node under a point of the drawing, at so many pixels a column. */
export function nodeAt(scene: Scene, cell: number, { x, y }: Point): number[] | null {
  const near = Math.min(0.4, Math.max(0.12, 9 / cell));
  const [a, b] = scene.pair;
  const known = [...scene.cut, ...[...scene.nodes.values()].map((own) => own.places)].filter((places) =>
    places.some((place) => place & 1),
  );
  for (const places of known) {
    const at = pointOf(scene, places);
    if (Math.hypot(at.x - x, at.y - y) < Math.min(near, 0.15)) return places;
  }
  const [i, j] = [a < 0 ? 0 : Math.round(y / ASPECT), Math.round(x)];
  const [rows, cols] = scene.size;
  if (i < 0 || j < 0 || i >= rows || j >= cols) return null;
  if (Math.abs(x - j) > near || Math.abs(y - (a < 0 ? 0 : i * ASPECT)) > near * 0.7) return null;
  const found = scene.nodes.get(`${a < 0 ? 0 : 2 * i},${2 * j}`);
  if (found) return found.places;
  return scene.subject.bands.length > 2
    ? null
    : scene.subject.bands.map((_, n) => (n === a ? 2 * i : n === b ? 2 * j : 0));
}

/** The arc that is nearest to a point, of those that are near. */
export function arcAt(scene: Scene, cell: number, at: Point): Arc | null {
  let [found, best]: [Arc | null, number] = [null, 8 / cell];
  for (const arc of scene.arcs) {
    const [p, q, r] = curveOf(scene, arc);
    if (Math.max(p.x, q.x, r.x) < at.x - best || Math.min(p.x, q.x, r.x) > at.x + best) continue;
    for (let n = 0; n <= 16; n++) {
      const t = n / 16;
      const [u, v, w] = [(1 - t) ** 2, 2 * t * (1 - t), t * t];
      const distance = Math.hypot(u * p.x + v * q.x + w * r.x - at.x, u * p.y + v * q.y + w * r.y - at.y);
      const favour = arc.kind === "path" || arc.kind === "choice" ? 0.7 : 1;
      if (distance * favour < best) [found, best] = [arc, distance * favour];
    }
  }
  return found;
}

/** The node to which an arrow key leads; null for another key. */
export function nodeTowards(scene: Scene, key: string): number[] | null {
  const moves: Record<string, [number, number]> = {
    ArrowLeft: [0, -1],
    ArrowRight: [0, 1],
    ArrowUp: [-1, 0],
    ArrowDown: [1, 0],
  };
  const move = moves[key];
  if (!move) return null;
  const [a, b] = scene.pair;
  const places = [...(scene.focus ?? scene.subject.bands.map(() => 0))];
  const go = (band: number, by: number) => {
    if (band < 0 || !by) return;
    const most = 2 * (scene.subject.bands[band]?.letters.length ?? 0);
    const at = places[band] ?? 0;
    places[band] = Math.max(0, Math.min(most, at & 1 ? at + by : at + 2 * by));
  };
  go(a, move[0]);
  go(b, move[1]);
  return places;
}
