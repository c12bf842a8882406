// One view's part of the graphics card: the building, the ground and the light, ready to be painted.

import { context } from "../pipeline/context.ts";
import { Pipeline, type Source } from "../pipeline/pipeline.ts";
import { Fitted } from "../town/fitted.ts";
import { cropped, daylight, frustumOf, isDay, type Sunlight, sunlightOf, uniformsOf } from "../town/frame.ts";
import type { Scenery } from "../town/painting.ts";
import { sideNeeded } from "../town/tiles.ts";
import type { Place } from "../town/types.ts";
import type { BuildingData } from "./data.ts";
import { distanceOf, type Look, placeOf, targetOf } from "./orbit.ts";
import type { Light, Mesh, Pass, Pixels, Values, Vector, Works } from "./types.ts";

const TILE_BYTES = 48e6; // of the card, in one image
const SHARE = 0.5; // of the distance: half the side of the fine map of shadows
const STEP = 2 ** 0.5; // that side goes in steps, so that a map does for a while
const NEAREST = 0.02; // metres

export class BuildingScenery implements Scenery {
  pipeline: Pipeline | null = null;
  /** Pixels across of the picture, and how many times as wide as high it is. */
  wide = 720;
  aspect = 1.5;
  private readonly fitted = new Fitted();
  private mesh: Mesh | null = null;
  private works: Works | null = null;

  constructor(
    private readonly data: BuildingData,
    private readonly looks: () => { look: Look; hour: number },
  ) {}

  get drawable(): boolean {
    return !!this.pipeline && !!this.fitted.images;
  }

  get place(): Place {
    return placeOf(this.looks().look, this.body, this.aspect);
  }

  get hour(): number {
    return this.looks().hour;
  }

  get light(): Light {
    return daylight((this.works as Works).hours, this.hour);
  }

  get head(): { box: number[]; sunlight: Works["sunlight"] } | null {
    const { works, mesh } = this;
    if (!works || !mesh) return null;
    const { look } = this.looks();
    const half = SHARE * distanceOf(look, this.body, this.aspect);
    const near = Math.max(1.5, STEP ** Math.ceil(Math.log(half) / Math.log(STEP)));
    return { box: mesh.sunny, sunlight: { ...works.sunlight, near, rise: 0 } };
  }

  /** The box of what is looked at. */
  get body(): number[] {
    return this.mesh?.body ?? this.data.mesh?.body ?? [0, 0, 0, 1, 1, 1];
  }

  /** Whether the picture has all the tiles that it needs, as far as is known here. */
  get settled(): boolean {
    return this.data.settled && this.fitted.of(this.data.tiles);
  }

  /** Take what has come; says what there is to draw anew. */
  take(): "mesh" | "tiles" | null {
    const { works, mesh } = this.data;
    if (!works || !mesh || context().whyNot) return null;
    const other = works !== this.works || mesh !== this.mesh;
    this.works = works;
    this.mesh = mesh;
    if (!this.arrange(other)) return null;
    return other ? "mesh" : "tiles";
  }

  /** Give the card finer tiles where the view needs them and they have come. */
  arrange(other = false): boolean {
    const { works, mesh, data } = this;
    if (!works || !mesh) return false;
    const needed = sideNeeded(this.place, this.wide, mesh.body.slice(0, 3), mesh.body.slice(3));
    data.want(needed);
    const fine = this.fitted.fit(data.tiles, needed, { bytes: TILE_BYTES, most: context().largest }, false);
    if (!other && !fine) return false;
    if (this.pipeline) this.pipeline.replace(this.source(works, mesh));
    else this.pipeline = new Pipeline(this.source(works, mesh));
    return true;
  }

  /** Around what is looked at, wherever the eye goes. */
  sun(): Sunlight {
    const head = this.head as NonNullable<BuildingScenery["head"]>;
    const { look } = this.looks();
    const [x, y, z] = targetOf(look, this.body).map((at) => Math.round(at * 2) / 2) as Vector;
    return sunlightOf(this.light.towards as Vector, { eye: [x, y, z], ahead: [0, 0, 0] }, head.box, head.sunlight, [
      x,
      y,
      z,
    ]);
  }

  passes(): Pass[] {
    const sun = isDay(this.light);
    return (this.pipeline?.passes ?? []).filter(({ when }) => when !== "shadow" || sun);
  }

  values(pixels: Pixels, _off?: readonly string[], part?: [number, number, number, number], sun = this.sun()): Values {
    const { works, head, place, body } = this;
    let frustum = frustumOf(place, pixels);
    const away = Math.hypot(
      ...[0, 1, 2].map((k) =>
        Math.max((body[k] as number) - (place[k] as number), 0, (place[k] as number) - (body[k + 3] as number)),
      ),
    );
    frustum.reach[0] = Math.max(NEAREST, Math.min(frustum.reach[0], 0.4 * away));
    if (part) frustum = cropped(frustum, ...part);
    return uniformsOf(
      { ...(head as NonNullable<typeof head>), looks: (works as Works).looks },
      frustum,
      this.light,
      part ? [1, 1] : pixels,
      { shadow: true, occlusion: true },
      sun,
    );
  }

  runs(): Pixels[] {
    return this.mesh ? [[0, this.mesh.indices.length / 4]] : [];
  }

  /** Give back what it holds of the card; it is taken again when the next picture is drawn. */
  free(): void {
    this.pipeline?.free();
  }

  /** Forget all: nobody looks. */
  drop(): void {
    this.free();
    this.pipeline = null;
    this.mesh = this.works = null;
  }

  private source(works: Works, mesh: Mesh): Source {
    const textures = Object.fromEntries(
      Object.entries(works.images).map(([name, image]) => [
        name,
        { image, content: works.textures[name] as Uint8Array },
      ]),
    );
    return {
      passes: works.passes,
      buffers: works.buffers,
      shaders: works.shaders,
      stride: works.stride,
      attributes: works.attributes,
      vertices: mesh.vertices,
      indices: mesh.indices,
      turning: mesh.turning,
      textures: { ...textures, ...this.fitted.images },
    };
  }
}
