// What facade_nb/widgets/town/packet.py packs.

import type { Buffer, Image, Pass } from "../pipeline/types.ts";

export type { Buffer, Image, Pass, Pixels, Value, Values } from "../pipeline/types.ts";

export type Vector = [number, number, number];
/** x, y, z in metres; yaw, pitch, angle in degrees (Python: Viewpoint). */
export type Place = [x: number, y: number, z: number, yaw: number, pitch: number, angle: number];
export interface Chunks {
  first: Int32Array;
  count: Int32Array;
  low: Float32Array;
  high: Float32Array;
  needs: Int32Array;
  blocks: Int32Array;
}

export interface BlobInfo {
  bytes: number;
  block: number;
  version: number;
}

export interface Buildings {
  styles: string[];
  kinds: string[];
  roofs: string[];
  seed: Int32Array;
  style: Int32Array;
  storeys: Int32Array;
  eaves: Float32Array;
  rise: Float32Array;
  roof: Int32Array;
  kind: Int32Array;
  /** Of the grammar. */
  parts: string[];
}

export type Light = Record<string, number | number[]>;

export interface Head {
  passes: Pass[];
  buffers: Buffer[];
  /** Sources by pass: `grammar:fragment`. */
  shaders: Record<string, string>;
  hours: Light[];
  sunlight: Record<"near" | "rise" | "stands" | "most" | "far" | "wider" | "side" | "above" | "each", number>;
  looks: { haze: number; reach: number };
  stride: number;
  attributes: Record<string, [count: number, offset: number]>;
  /** Vertices of a block. */
  block: number;
  blobs: Record<string, BlobInfo>;
  textures: Record<string, Image>;
  /** Names, in the order of their numbers. */
  tiles: string[];
  /** What their image may take of the card. */
  tile_bytes: number;
  grammar: Uint8Array;
  chunks: Chunks;
  /** The first index of what turns to whoever looks. */
  turning: number;
  box: number[];
  views: Record<string, Place>;
  /** Metres of the eye of one who walks. */
  eye: number;
  report: string;
  /** Column and row of the rules that walls may begin with. */
  starts: number[];
  town: Buildings | null;
}

/** A place on a path. */
export interface Stop {
  time: number;
  eye: Vector;
  yaw: number;
  pitch: number;
  angle: number;
}
