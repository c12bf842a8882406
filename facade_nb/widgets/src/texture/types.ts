// What facade_nb/widgets/texture/packet.py packs.

import type { Light } from "../pipeline/camera.ts";
import type { Buffer, Pass } from "../pipeline/types.ts";

export type Pair = [number, number];
export type Triple = [number, number, number];

export interface TablePixel {
  at: Pair;
  channels: [label: string, value: string][];
}
export interface TableRule {
  name: string;
  operator: string;
  pixels: TablePixel[];
}

/** A grammar: its texture to the bit, and the shaders that are large enough for it. */
export interface Scene {
  width: number;
  height: number;
  bits: 16 | 32;
  texture: Uint8Array;
  start: Pair;
  /** Of the passes that evaluate it. */
  shaders: Record<string, string>;
  report: string;
  table: TableRule[];
}

export interface Tiles {
  width: number;
  height: number;
  pixels: Uint8Array;
  levels: number;
  count: number;
  table: Float32Array;
}

export type { Light } from "../pipeline/camera.ts";

/** What is the same for all grammars. */
export interface Common {
  passes: Pass[];
  buffers: Buffer[];
  shaders: Record<string, string>;
  stride: number;
  attributes: Record<string, [count: number, offset: number]>;
  hours: Light[];
}

export interface Step {
  rule: string;
  operator: string;
  text: string;
  scope: [number, number, number, number];
  /** The scope's corners and the pixel's place in space, metres: z is out of the façade, rooms lie below 0. */
  corners: Triple[];
  spot: Triple;
  faces: string[];
  layers: Pair[];
  seeds: Pair[];
  records: Pair[];
  color: number[] | null;
}
