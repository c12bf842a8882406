// One WebGL2 context for all views of the page: it draws, and each view copies the picture into its own canvas. So there
// are never more contexts than browsers allow, and no view goes blank. What a lost context held is made again.

import type { Sight } from "./sight.ts";
import type { Common, Light, Pair, Scene, Tiles } from "./types.ts";

export interface Job {
  common: Common;
  scene: Scene;
  tiles: Tiles;
  sight: Sight;
  size: Pair;
  seed: Pair;
  /** The light; null: colours as they are. */
  light: Light | null;
}

/** The light of an hour, between those that Python has told. */
export function lightAt(hours: Light[], hour: number): Light {
  const at = Math.min(Math.max(hour / 24, 0), 1) * (hours.length - 1);
  const low = hours[Math.floor(at)] as Light;
  const high = hours[Math.ceil(at)] as Light;
  const part = at - Math.floor(at);
  const mix = (a: number, b: number) => a + (b - a) * part;
  return Object.fromEntries(
    Object.entries(low).map(([name, value]) => {
      const other = high[name];
      return [
        name,
        Array.isArray(value)
          ? value.map((own, k) => mix(own, (other as number[])[k] as number))
          : mix(value, other as number),
      ];
    }),
  );
}

/** A seed in metres as whole steps of 1/64 m, wrapped to 32 bits, and what is left (Python: noise.py). */
export function seedOf(seed: Pair): { whole: Pair; rest: Pair } {
  const whole = seed.map((value) => Math.floor(value * 64)) as Pair;
  return {
    whole: whole.map((value) => ((value % 2 ** 32) + 2 ** 32) % 2 ** 32) as Pair,
    rest: seed.map((value, k) => value * 64 - (whole[k] as number)) as Pair,
  };
}

interface Target {
  frame: WebGLFramebuffer;
  textures: WebGLTexture[];
  width: number;
  height: number;
}

interface Begun {
  program: WebGLProgram;
  shaders: WebGLShader[];
  checked: boolean;
}

const PARTS = ["seen_color", "seen_normal", "seen_specular"] as const;

export class Renderer {
  readonly canvas = document.createElement("canvas");
  private gl: WebGL2RenderingContext | null = null;
  private programs = new Map<string, Begun>();
  private textures = new Map<object, WebGLTexture[]>();
  private target: Target | null = null;
  private readonly watchers = new Set<() => void>();
  /** How many contexts have been made. */
  made = 0;

  constructor() {
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.forget();
    });
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.made += 1;
      for (const redraw of [...this.watchers]) redraw();
    });
  }

  /** Be told when a lost context has come back; until the signal ends. The last watcher's end frees what was made. */
  watch(redraw: () => void, signal: AbortSignal): void {
    this.watchers.add(redraw);
    signal.addEventListener("abort", () => {
      this.watchers.delete(redraw);
      if (this.watchers.size === 0) this.free();
    });
  }

  /** Whether it draws without a graphics card: then pictures are copied into canvases in main memory. */
  get software(): boolean {
    try {
      const gl = this.context();
      const names = gl?.getExtension("WEBGL_debug_renderer_info");
      return /swiftshader|llvmpipe|softpipe|software/i.test(
        String(gl?.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER)),
      );
    } catch {
      return true;
    }
  }

  /** Let the browser take the context, and give it back: what a driver's reset does. */
  async lose(): Promise<void> {
    const extension = this.context()?.getExtension("WEBGL_lose_context");
    if (!extension) return;
    extension.loseContext();
    await new Promise((done) => setTimeout(done, 100));
    extension.restoreContext();
  }

  /** Why nothing can be drawn here; empty if it can. */
  get whyNot(): string {
    try {
      this.context();
      return "";
    } catch (error) {
      return error instanceof Error ? error.message : String(error);
    }
  }

  /** Whether the shader of the smooth picture is there; if not, it is on its way, which does not stall the page. */
  smoothReady({ common, scene }: Job): boolean {
    const gl = this.context();
    if (gl.isContextLost()) return true;
    return this.ready(gl, this.begun(gl, common.vertex, scene.smooth));
  }

  /**
   * Draw the rows from `low` to `high`, from the bottom, of a picture, and copy them, stretched over the same part of
   * `to`; with more samples at boundaries if it is to be smooth. Returns false while the context is lost.
   */
  draw(
    job: Job,
    to: CanvasRenderingContext2D,
    width: number,
    height: number,
    low = 0,
    high = height,
    smooth = false,
  ): boolean {
    const gl = this.context();
    if (gl.isContextLost()) return false;
    const target = this.room(gl, width, height);
    gl.viewport(0, 0, width, height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, low, width, high - low);
    if (smooth) {
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      const only = this.facade(gl, job, job.scene.smooth, width, height);
      gl.uniform1f(gl.getUniformLocation(only, "lit"), job.light ? 1 : 0);
      lighten(gl, only, job);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    } else {
      gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
      this.facade(gl, job, job.scene.fragment, width, height);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      const second = this.program(gl, job.common.vertex, job.light ? job.common.lit : job.common.plain);
      gl.useProgram(second);
      bind(gl, second, Object.fromEntries(PARTS.map((name, k) => [name, target.textures[k]])));
      aim(gl, second, job.sight, width, height);
      lighten(gl, second, job);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    // Wait for it: only so is the time that a picture takes known, and a slow one does not pile up.
    gl.readPixels(0, low, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    if (gl.isContextLost()) return false;

    const [wide, tall] = [to.canvas.width, to.canvas.height];
    const [y0, y1] = [((height - high) / height) * tall, ((height - low) / height) * tall];
    to.clearRect(0, y0, wide, y1 - y0);
    to.drawImage(this.canvas, 0, this.canvas.height - high, width, high - low, 0, y0, wide, y1 - y0);
    return true;
  }

  /** Take a program that evaluates the grammar into use, with all that it is given. */
  private facade(gl: WebGL2RenderingContext, job: Job, fragment: string, width: number, height: number): WebGLProgram {
    const { scene, tiles, common, sight } = job;
    const own = (key: object, make: () => WebGLTexture[]) => {
      let found = this.textures.get(key);
      if (!found) {
        found = make();
        this.textures.set(key, found);
      }
      return found;
    };
    const half = scene.bits === 16;
    const view = scene.texture;
    const [grammar] = own(scene, () => [
      texture(
        gl,
        half ? gl.RGBA16F : gl.RGBA32F,
        scene.width,
        scene.height,
        gl.RGBA,
        half ? gl.HALF_FLOAT : gl.FLOAT,
        half
          ? new Uint16Array(view.buffer, view.byteOffset, view.byteLength / 2)
          : new Float32Array(view.buffer, view.byteOffset, view.byteLength / 4),
      ),
    ]);
    const [noise] = own(common, () => [texture(gl, gl.R32F, common.side, common.side, gl.RED, gl.FLOAT, common.noise)]);
    const [atlas, table] = own(tiles, () => [
      texture(gl, gl.RGBA8, tiles.width, tiles.height, gl.RGBA, gl.UNSIGNED_BYTE, tiles.pixels),
      texture(gl, gl.RGBA32F, tiles.levels, tiles.count, gl.RGBA, gl.FLOAT, tiles.table),
    ]);

    const program = this.program(gl, common.vertex, fragment);
    gl.useProgram(program);
    bind(gl, program, { grammar, noise, atlas, tile_table: table });
    const step = aim(gl, program, sight, width, height);
    const seed = seedOf(job.seed);
    const at = (name: string) => gl.getUniformLocation(program, name);
    gl.uniform2f(at("pixel_shift"), 0.5, 0.5);
    gl.uniform1f(at("spread"), sight.eye ? Math.min(...step) : 0);
    gl.uniform2f(at("facade_size"), ...job.size);
    gl.uniform2i(at("start_rule"), ...scene.start);
    gl.uniform1i(at("grammar_width"), scene.width);
    gl.uniform2ui(at("seed_whole"), ...seed.whole);
    gl.uniform2f(at("seed_rest"), ...seed.rest);
    return program;
  }

  /** Drop a grammar's or a set's textures. */
  release(key: object): void {
    for (const own of this.textures.get(key) ?? []) this.gl?.deleteTexture(own);
    this.textures.delete(key);
  }

  private context(): WebGL2RenderingContext {
    if (!this.gl) {
      this.gl = this.canvas.getContext("webgl2", { antialias: false, depth: false, alpha: true });
      if (!this.gl) throw new Error("This browser offers no WebGL2, with which the façade is drawn.");
      this.made += 1;
    }
    if (!this.gl.isContextLost() && !this.gl.getExtension("EXT_color_buffer_float"))
      throw new Error("This browser's WebGL2 has no EXT_color_buffer_float, which the picture needs.");
    return this.gl;
  }

  /** A program that may still be compiled beside the page. */
  private begun(gl: WebGL2RenderingContext, vertex: string, fragment: string): Begun {
    let found = this.programs.get(fragment);
    if (found) return found;
    const program = gl.createProgram();
    const shaders = (
      [
        [gl.VERTEX_SHADER, vertex],
        [gl.FRAGMENT_SHADER, fragment],
      ] as const
    ).map(([kind, source]) => {
      const shader = gl.createShader(kind) as WebGLShader;
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      return shader;
    });
    gl.linkProgram(program);
    found = { program, shaders, checked: false };
    this.programs.set(fragment, found);
    return found;
  }

  private ready(gl: WebGL2RenderingContext, { program, checked }: Begun): boolean {
    const parallel = gl.getExtension("KHR_parallel_shader_compile");
    return checked || !parallel || gl.getProgramParameter(program, parallel.COMPLETION_STATUS_KHR) !== false;
  }

  private program(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram {
    const found = this.begun(gl, vertex, fragment);
    if (!found.checked && !gl.isContextLost() && !gl.getProgramParameter(found.program, gl.LINK_STATUS)) {
      const told = [...found.shaders.map((one) => gl.getShaderInfoLog(one)), gl.getProgramInfoLog(found.program)];
      throw new Error(`The shader does not compile: ${told.filter(Boolean).join("\n")}`);
    }
    found.checked = true;
    return found.program;
  }

  /** Room for a picture: it only ever grows. */
  private room(gl: WebGL2RenderingContext, width: number, height: number): Target {
    const old = this.target;
    if (old && old.width >= width && old.height >= height) return old;
    const wide = Math.max(width, old?.width ?? 0);
    const tall = Math.max(height, old?.height ?? 0);
    for (const own of old?.textures ?? []) gl.deleteTexture(own);
    if (old) gl.deleteFramebuffer(old.frame);
    this.canvas.width = wide;
    this.canvas.height = tall;
    const frame = gl.createFramebuffer() as WebGLFramebuffer;
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    const textures = PARTS.map((_, k) => {
      const format = k === 0 ? gl.RGBA32F : gl.RGBA16F;
      const own = texture(gl, format, wide, tall, gl.RGBA, gl.FLOAT, null);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + k, gl.TEXTURE_2D, own, 0);
      return own;
    });
    gl.drawBuffers([gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1, gl.COLOR_ATTACHMENT2]);
    this.target = { frame, textures, width: wide, height: tall };
    return this.target;
  }

  private forget(): void {
    this.programs = new Map();
    this.textures = new Map();
    this.target = null;
  }

  private free(): void {
    const { gl, target } = this;
    if (gl && !gl.isContextLost()) {
      for (const key of [...this.textures.keys()]) this.release(key);
      for (const own of target?.textures ?? []) gl.deleteTexture(own);
      if (target) gl.deleteFramebuffer(target.frame);
      this.target = null;
    }
  }
}

function texture(
  gl: WebGL2RenderingContext,
  format: number,
  width: number,
  height: number,
  channels: number,
  type: number,
  data: ArrayBufferView | null,
): WebGLTexture {
  const own = gl.createTexture() as WebGLTexture;
  gl.bindTexture(gl.TEXTURE_2D, own);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, channels, type, data);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  return own;
}

/** Tell a program where it looks; returns what a pixel covers across and up. */
function aim(gl: WebGL2RenderingContext, program: WebGLProgram, sight: Sight, width: number, height: number): Pair {
  const [left, bottom, right, top] = sight.window;
  const step: Pair = [(right - left) / width, (top - bottom) / height];
  const at = (name: string) => gl.getUniformLocation(program, name);
  gl.uniform4f(at("window"), left, bottom, ...step);
  gl.uniform4f(at("eye"), ...(sight.eye ?? ([0, 0, 0] as const)), sight.eye ? 1 : 0);
  gl.uniform3f(at("across"), ...sight.right);
  gl.uniform3f(at("forward"), ...sight.ahead);
  return step;
}

/** Tell a program the light of the hour. */
function lighten(gl: WebGL2RenderingContext, program: WebGLProgram, { light }: Job): void {
  for (const [name, value] of Object.entries(light ?? {})) {
    const at = gl.getUniformLocation(program, name);
    if (typeof value === "number") gl.uniform1f(at, value);
    else if (value.length === 2) gl.uniform2fv(at, value);
    else gl.uniform3fv(at, value);
  }
}

function bind(
  gl: WebGL2RenderingContext,
  program: WebGLProgram,
  textures: Record<string, WebGLTexture | undefined>,
): void {
  Object.entries(textures).forEach(([name, own], unit) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, own ?? null);
    gl.uniform1i(gl.getUniformLocation(program, name), unit);
  });
}

const KEY = Symbol.for("facade_nb.texture.renderer");
const shared = globalThis as { [KEY]?: Renderer };

/** The page's renderer. */
export function renderer(): Renderer {
  shared[KEY] ??= new Renderer();
  return shared[KEY];
}
