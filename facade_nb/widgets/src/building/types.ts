// What facade_nb/widgets/studio/mesh_pieces.py packs.

import type { Light } from "../pipeline/camera.ts";
import type { Buffer, Image, Pass } from "../pipeline/types.ts";
import type { TileInfo } from "../town/tiles.ts";

export type { Light, Matrix, Vector } from "../pipeline/camera.ts";
export type { Pass, Pixels, Values } from "../pipeline/types.ts";

/** All that draws meshes of a grammar. */
export interface Works {
  passes: Pass[];
  buffers: Buffer[];
  shaders: Record<string, string>;
  hours: Light[];
  sunlight: Record<"near" | "rise" | "stands" | "most" | "far" | "wider" | "side" | "above" | "each", number>;
  looks: { haze: number; reach: number };
  stride: number;
  attributes: Record<string, [count: number, offset: number]>;
  images: Record<string, Image>;
  textures: Record<string, Uint8Array>;
  tiles: string[];
  told: TileInfo[];
  coarse: Uint8Array;
}

/** The triangles of a layout as they are sent: what is the same all over a flat piece, once. */
export interface Packed {
  /** Position and place of each vertex. */
  varying: Float32Array;
  /** All else that a vertex carries, of each flat piece. */
  facets: Float32Array;
  facet: Int32Array;
  indices: Int32Array;
  turning: number;
  /** The shape that each triangle belongs to; -1, -2: none; from OTHER down another wall, by its number in `walls`. */
  shapes: Int32Array;
  /** Least and greatest coordinates of what throws shadows, and of the building. */
  sunny: number[];
  body: number[];
  canvas: [width: number, height: number];
  names: string[];
  /** The walls of a building that can be chosen; empty: it is a façade by itself. */
  walls: string[];
  /** Layer and symbols of each shape: numbers of names. */
  placed: Int32Array;
}

/** The same as the pipeline and the picker want it. */
export interface Mesh extends Omit<Packed, "varying" | "facets" | "facet" | "indices"> {
  /** Records of the pipeline's vertices. */
  vertices: Uint8Array;
  indices: Uint8Array;
  /** The corners of each triangle: 9 numbers. */
  corners: Float32Array;
}
