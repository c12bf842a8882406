// Far away less is drawn: the triangles of a chunk stand in the order of their size, and those that are much smaller than
// a pixel are left out.

import type { Chunks, Head, Pixels, Place } from "./types.ts";

const SEEN = 0.25; // of a pixel that a triangle takes at least, seen straight on

export class Detail {
  /** Areas of the triangles of each chunk, the largest first. */
  private readonly areas = new Map<number, Float32Array>();

  /** Order the triangles of a chunk, in the bytes of all; from where to where in those of the indices it lies. */
  take(
    chunk: number,
    { chunks, stride, attributes }: Pick<Head, "chunks" | "stride" | "attributes">,
    vertices: Uint8Array,
    indices: Uint8Array,
  ): Pixels {
    const [first, count] = [chunks.first[chunk] as number, chunks.count[chunk] as number];
    this.sort(
      chunk,
      new Uint32Array(indices.buffer as ArrayBuffer, 4 * first, count),
      new Float32Array(vertices.buffer as ArrayBuffer, 0, vertices.length / 4),
      stride / 4,
      (attributes.position?.[1] ?? 0) / 4,
    );
    return [4 * first, 4 * (first + count)];
  }

  /**
   * Put the triangles of a chunk in the order of their size, in place. `vertices`: their positions begin at `offset`, every
   * `stride` numbers.
   */
  sort(chunk: number, indices: Uint32Array, vertices: Float32Array, stride: number, offset: number): void {
    const count = indices.length / 3;
    const sizes = new Float32Array(count);
    for (let k = 0; k < count; k += 1) {
      const [a, b, c] = [0, 1, 2].map((corner) => stride * (indices[3 * k + corner] as number) + offset) as [
        number,
        number,
        number,
      ];
      const side = (to: number, axis: number) => (vertices[to + axis] as number) - (vertices[a + axis] as number);
      const [ux, uy, uz, vx, vy, vz] = [side(b, 0), side(b, 1), side(b, 2), side(c, 0), side(c, 1), side(c, 2)];
      sizes[k] = Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
    }
    const order = Uint32Array.from(sizes.keys()).sort((a, b) => (sizes[b] as number) - (sizes[a] as number) || a - b);
    const before = indices.slice();
    order.forEach((from, to) => {
      indices.set(before.subarray(3 * from, 3 * from + 3), 3 * to);
    });
    this.areas.set(
      chunk,
      Float32Array.from(order, (k) => sizes[k] as number),
    );
  }

  /** How many indices of a chunk are worth drawing in a picture of so many pixels. */
  count(chunk: number, { low, high, count }: Chunks, place: Place, [wide]: Pixels): number {
    const all = count[chunk] as number;
    const own = this.areas.get(chunk);
    if (!own) return all;
    let far = 0;
    for (let axis = 0; axis < 3; axis += 1) {
      const at = place[axis] as number;
      far += Math.max((low[3 * chunk + axis] as number) - at, 0, at - (high[3 * chunk + axis] as number)) ** 2;
    }
    const pixel = (2 * Math.tan((place[5] * Math.PI) / 360)) / wide;
    const least = SEEN * pixel * pixel * far;
    let [first, last] = [0, own.length]; // the first that is too small lies between
    while (first < last) {
      const middle = (first + last) >> 1;
      if ((own[middle] as number) >= least) first = middle + 1;
      else last = middle;
    }
    return 3 * first;
  }
}
