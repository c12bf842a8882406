// What is pointed at and what is picked, in one view of a building: found, told to the other parts, marked.

import { mark } from "../shared/dom.ts";
import type { Context } from "../studio/common.ts";
import { belongs, watchLinks } from "../studio/links.ts";
import { type Painting, pixelsOf } from "../town/painting.ts";
import type { BuildingData } from "./data.ts";
import { drawMarks, isMarked } from "./marks.ts";
import { cameraOf, rayOf } from "./orbit.ts";
import type { BuildingScenery } from "./scenery.ts";
import { met, type Seen, seenBy } from "./seen.ts";
import type { Vector } from "./types.ts";

const NONE: ReadonlySet<number> = new Set();
const OTHER = -3; // as whole.py has it

interface Named {
  layer: string;
  x: string;
  y: string;
}

export interface Marking {
  /** Mark anew, with the next frame. `moved`: the picture is another one. */
  show(moved?: boolean): void;
  /** The point of the building, and its shape, at a place of the picture (0 to 1 from its lower left); null: beside it. */
  meet(across: number, up: number): { point: Vector; shape: number } | null;
  /** The pointer is there; null: it has left. */
  hover(at: { across: number; up: number } | null): void;
  /** The number of the wall of a building that a triangle is of, when it is another than that edited; -1: none. */
  wallOf(shape: number): number;
}

interface Parts {
  canvas: HTMLCanvasElement;
  over: HTMLCanvasElement;
  data: BuildingData;
  scenery: BuildingScenery;
  painting(): Painting | null;
}

export function marking({ store, signal }: Context, { canvas, over, data, scenery, painting }: Parts): Marking {
  let seen: Seen | null = null;
  let fresh = false; // whether `seen` is of the picture as it is
  let hovered = -1;
  let lit = NONE;
  let frame = 0;

  const shapeOf = (index: number): Named => {
    const { mesh } = data;
    const name = (k: number) => mesh?.names[mesh.placed[3 * index + k] as number] ?? "";
    return { layer: name(0), x: name(1), y: name(2) };
  };
  const shapesLike = (test: (shape: Named) => boolean): ReadonlySet<number> => {
    const count = (data.mesh?.placed.length ?? 0) / 3;
    return new Set(Array.from({ length: count }, (_, k) => k).filter((k) => test(shapeOf(k))));
  };
  const marked = () => {
    const { shape, layer, x, y, more } = store.get("selection");
    const pairs = layer !== "" && x !== "" && y !== "" ? [[x, y], ...more] : [];
    const alike = (own: Named) =>
      pairs.length > 0
        ? own.layer === layer && pairs.some(([a, b]) => own.x === a && own.y === b)
        : (layer !== "" && own.layer === layer) || (x !== "" && own.x === x) || (y !== "" && own.y === y);
    return {
      picked: shape ?? -1,
      alike: layer || x || y ? shapesLike(alike) : NONE,
      lit,
      hovered,
      framed: (data.mesh?.walls.length ?? 0) > 1,
    };
  };
  const draw = () => {
    const paper = over.getContext("2d");
    const paint = painting();
    const { mesh } = data;
    if (!paper || !mesh || !paint?.last) return;
    const own = marked();
    // While it moves, what is marked is as coarse as the picture.
    const [width, height] = !isMarked(own) ? [1, 1] : pixelsOf(canvas, paint.done ? 1 : 2);
    if (over.width !== width || over.height !== height) {
      over.width = width;
      over.height = height;
    }
    if (!isMarked(own)) {
      paper.clearRect(0, 0, 1, 1);
      return;
    }
    if (!fresh || seen?.width !== width || seen.height !== height) {
      seen = seenBy(mesh.corners, cameraOf(scenery.place, [width, height]), width, height, seen ?? undefined);
      fresh = true;
    }
    const image = paper.createImageData(width, height);
    drawMarks(seen, mesh.shapes, own, image, Math.max(1, Math.round(width / Math.max(1, canvas.clientWidth))));
    paper.putImageData(image, 0, 0);
  };
  const show = (moved = false) => {
    if (moved) fresh = false;
    cancelAnimationFrame(frame);
    frame = requestAnimationFrame(draw);
  };
  const meet: Marking["meet"] = (across, up) => {
    const { mesh } = data;
    if (!mesh) return null;
    const { eye, ray } = rayOf(scenery.place, [canvas.width, canvas.height], across, up);
    const found = met(mesh.corners, eye, ray);
    if (!found) return null;
    const point = eye.map((at, k) => at + found.far * (ray[k] as number)) as Vector;
    return { point, shape: mesh.shapes[found.triangle] as number };
  };
  const wallOf = (shape: number) => (shape <= OTHER ? OTHER - shape : -1);
  const hover: Marking["hover"] = (at) => {
    const found = (at && meet(at.across, at.up)?.shape) ?? -1;
    const shape = Math.max(-1, found);
    const wall = data.mesh?.walls[wallOf(found)];
    mark(canvas, "title", wall ? `Edit ${wall}` : null);
    mark(canvas, "data-wall", wall ?? null);
    if (shape === hovered) return;
    hovered = shape;
    mark(canvas, "data-over", shape >= 0);
    // The canvas stands for the shape that is pointed at: so the other parts are told as by an element of the page.
    const own =
      shape >= 0 ? { shape: String(shape), ...shapeOf(shape) } : { shape: null, layer: null, x: null, y: null };
    for (const [name, value] of Object.entries(own)) mark(canvas, `data-${name}`, value);
    canvas.dispatchEvent(new PointerEvent("pointerover", { bubbles: true }));
    show();
  };

  watchLinks(
    store.prefix,
    (pointed, from) => {
      lit = from === canvas ? NONE : shapesLike((shape) => belongs(shape, pointed));
      show();
    },
    signal,
  );
  store.watch(["selection"], show);
  signal.addEventListener("abort", () => cancelAnimationFrame(frame));
  return { show, meet, hover, wallOf };
}
