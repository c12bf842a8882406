// Maps of shadows are kept while what they were drawn from is the same, and textures are bound where they belong.

import { beforeEach, expect, it, vi } from "vitest";
import { context } from "../../src/pipeline/context.ts";
import { Pipeline, type Source } from "../../src/pipeline/pipeline.ts";
import { use } from "../../src/pipeline/programs.ts";
import type { Pass, Values } from "../../src/pipeline/types.ts";

const pass = (name: string, more: Partial<Pass>): Pass =>
  ({ name, reads: [], writes: ["map"], draws: "mesh", through: "sun", both: true, ...more }) as Pass;
const SOLID = pass("solid", { turning: false, adds: false });
const LEAVES = pass("leaves", { turning: true, adds: true });
const source = (atlas: Uint8Array): Source =>
  ({
    passes: [SOLID, LEAVES],
    buffers: [{ name: "map", channels: 1, kind: "depth", side: 4, part: 1 }],
    shaders: {},
    stride: 4,
    attributes: {},
    vertices: new Uint8Array(4),
    indices: new Uint8Array(12),
    turning: 0,
    textures: { atlas: { image: { size: [1, 1], channels: 4, kind: "f1" }, content: atlas } },
  }) as unknown as Source;
const seen = (turn: number): Values => ({ sun: new Float64Array(16).fill(turn) });

let clears = 0;
let pipeline: Pipeline;
beforeEach(() => {
  clears = 0;
  const gl = new Proxy({} as Record<string, unknown>, {
    get: (_, name) => {
      if (name === "clearBufferfv") return () => (clears += 1);
      if (name === "isContextLost") return () => false;
      if (name === "checkFramebufferStatus") return () => "FRAMEBUFFER_COMPLETE";
      if (name === "getProgramParameter") return (_program: unknown, what: string) => (what === "LINK_STATUS" ? 1 : 0);
      if (/^[A-Z_0-9]+$/.test(String(name))) return name === "COLOR_ATTACHMENT0" ? 0 : name;
      return () => (/^create/.test(String(name)) ? {} : null);
    },
  });
  vi.spyOn(context(), "get").mockReturnValue(gl as unknown as WebGL2RenderingContext);
  pipeline = new Pipeline(source(new Uint8Array(4)));
  return () => vi.restoreAllMocks();
});

const both = (values: Values) => [SOLID, LEAVES].map((own) => pipeline.fresh(own, values));
const draw = (own: Pass, values: Values, piece = {}) => pipeline.run(own, values, [8, 8], piece);

it("a map is kept for its matrix, and drawn again with other tiles: leaves are open where these are", () => {
  for (const own of [SOLID, LEAVES]) draw(own, seen(1));
  expect(both(seen(1))).toEqual([true, true]);
  expect(both(seen(2))).toEqual([false, false]);
  pipeline.replace(source(new Uint8Array(4)));
  expect(both(seen(1))).toEqual([false, false]);
});

it("what was cleared away is not taken to be there, nor what was begun to be whole", () => {
  for (const own of [SOLID, LEAVES]) draw(own, seen(1));
  draw(SOLID, seen(2)); // and then something came between
  draw(SOLID, seen(1));
  expect(both(seen(1))).toEqual([true, false]);
  draw(SOLID, seen(3), { first: true, last: false });
  expect(both(seen(3))).toEqual([false, false]);
  draw(LEAVES, seen(1)); // on a map of another matrix
  draw(SOLID, seen(3), { first: false, last: true });
  expect(both(seen(3))).toEqual([false, false]);
});

it("two views that draw the same map by turns do not clear what the other has drawn", () => {
  draw(SOLID, seen(1), { first: true, last: false });
  draw(SOLID, seen(1), { first: true, last: false });
  expect(clears).toBe(1);
  draw(SOLID, seen(1), { first: false, last: true });
  expect(both(seen(1))).toEqual([true, false]);
});

it("a texture that is made only when it is read takes no other's place", () => {
  const units: unknown[] = [];
  let unit = 0;
  const gl = {
    SAMPLER_2D: 1,
    TEXTURE0: 0,
    useProgram: () => {},
    activeTexture: (own: number) => {
      unit = own;
    },
    bindTexture: (_: unknown, texture: unknown) => {
      units[unit] = texture;
    },
    uniform1i: () => {},
  } as unknown as WebGL2RenderingContext;
  const uniforms = new Map(["grammar", "atlas"].map((name) => [name, { at: name, type: 1 }]));
  use(gl, { program: {}, shaders: [], uniforms } as unknown as Parameters<typeof use>[1], {}, (name) => {
    gl.activeTexture(0); // as it is filled
    gl.bindTexture(0, name as unknown as WebGLTexture);
    return name as unknown as WebGLTexture;
  });
  expect(units).toEqual(["grammar", "atlas"]);
});
