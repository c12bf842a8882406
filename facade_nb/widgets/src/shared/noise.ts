// The table of random numbers that every grammar reads: worked out here, so that it need not travel or be saved
// (Python: render/texture/noise.py). It holds each of 0, 1/65536, … once, in the order of their hashes.

const SIDE = 256;
const COUNT = SIDE * SIDE;

let made: Float32Array | null = null;

/** Its 256 × 256 numbers, row 0 at the bottom: always the same array. */
export function noiseTexture(): Float32Array<ArrayBuffer> {
  if (!made) {
    const hashed = Float64Array.from({ length: COUNT }, (_, k) => mixed(k + 1) * COUNT + k).sort();
    made = Float32Array.from(hashed, (value) => (value % COUNT) / COUNT);
  }
  return made as Float32Array<ArrayBuffer>;
}

/** The same as bytes, for the card: always the same array too. */
export function noiseBytes(): Uint8Array<ArrayBuffer> {
  bytes ??= new Uint8Array(noiseTexture().buffer);
  return bytes;
}

let bytes: Uint8Array<ArrayBuffer> | null = null;

/** A bijection of 32-bit integers in which every bit depends on all others. */
function mixed(value: number): number {
  let own = value;
  own ^= own >>> 16;
  own = Math.imul(own, 0x7feb352d);
  own ^= own >>> 15;
  own = Math.imul(own, 0x846ca68b);
  return (own ^ (own >>> 16)) >>> 0;
}
