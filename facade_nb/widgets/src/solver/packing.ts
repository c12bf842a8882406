// Reading what facade_nb/widgets/solver/packing.py wrote: JSON with arrays of numbers beside it, deflated.

const ARRAYS = {
  u1: Uint8Array,
  i2: Int16Array,
  i4: Int32Array,
  f4: Float32Array,
  f8: Float64Array,
} as const;

export type Bytes = DataView | ArrayBuffer | Uint8Array;

export function byteLength(bytes: Bytes | null | undefined): number {
  return bytes?.byteLength ?? 0;
}

/** The value in a piece of a trace. Arrays are views of one buffer: nothing is copied. */
export async function unpack<T>(bytes: Bytes): Promise<T> {
  const source =
    bytes instanceof ArrayBuffer
      ? new Uint8Array(bytes)
      : new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const { readable, writable } = new DecompressionStream("deflate");
  const writer = writable.getWriter();
  const written = writer.write(source as BufferSource).then(() => writer.close());
  const [data] = await Promise.all([new Response(readable).arrayBuffer(), written]);
  const length = new DataView(data).getUint32(0, true);
  const base = Math.ceil((4 + length) / 8) * 8;
  const text = new TextDecoder().decode(new Uint8Array(data, 4, length));
  return JSON.parse(text, (_, value) => {
    const place = value?.$ as [keyof typeof ARRAYS, number, number] | undefined;
    return Array.isArray(place) ? new ARRAYS[place[0]](data, base + place[1], place[2]) : value;
  }) as T;
}
