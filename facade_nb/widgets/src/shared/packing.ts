// Reading what facade_nb/widgets/shared/packing.py wrote: JSON with arrays of numbers beside it, deflated.

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

/** A message's bytes, however the host hands them over. */
export function bytesOf(bytes: Bytes): Uint8Array<ArrayBuffer> {
  return bytes instanceof ArrayBuffer
    ? new Uint8Array(bytes)
    : new Uint8Array(bytes.buffer as ArrayBuffer, bytes.byteOffset, bytes.byteLength);
}

export async function inflated(bytes: Bytes): Promise<ArrayBuffer> {
  const { readable, writable } = new DecompressionStream("deflate");
  const writer = writable.getWriter();
  const written = writer.write(bytesOf(bytes)).then(() => writer.close());
  const [data] = await Promise.all([new Response(readable).arrayBuffer(), written]);
  return data;
}

/** The value in a piece of a trace. Arrays are views of one buffer: nothing is copied. */
export async function unpack<T>(bytes: Bytes): Promise<T> {
  const data = await inflated(bytes);
  const length = new DataView(data).getUint32(0, true);
  const base = Math.ceil((4 + length) / 8) * 8;
  const text = new TextDecoder().decode(new Uint8Array(data, 4, length));
  return JSON.parse(text, (_, value) => {
    const place = value?.$ as [keyof typeof ARRAYS, number, number] | undefined;
    return Array.isArray(place) ? new ARRAYS[place[0]](data, base + place[1], place[2]) : value;
  }) as T;
}
