// Runs passes with WebGL2 (Python: render/pipeline/renderer.py). It knows no pass by its name: each says which buffers it
// reads and writes, and whether it draws the mesh or every pixel.

import { context } from "./context.ts";
import { begin, type Program, ready, use } from "./programs.ts";
import type { Buffer, Image, Pass, Pixels, Values } from "./types.ts";

export interface Source {
  passes: Pass[];
  buffers: Buffer[];
  shaders: Record<string, string>;
  stride: number;
  attributes: Record<string, [count: number, offset: number]>;
  vertices: Uint8Array;
  indices: Uint8Array;
  /** The first index of what turns to whoever looks: passes of their own draw that. */
  turning?: number;
  /** What shaders read beside buffers; in rows, which may come one after the other. */
  textures: Record<string, { image: Image; content: Uint8Array }>;
}

interface Held {
  texture: WebGLTexture;
  size: Pixels;
}

const OPENING = ["grammar", "atlas", "tile_table"]; // textures that say where leaves are open: maps are drawn by them, too
const POOL = 3; // sizes of pictures whose buffers are kept

const SHOW = `#version 300 es
precision highp float;
precision highp int;
uniform highp SAMPLER source;
uniform vec2 scale;
uniform vec4 low;
uniform vec4 high;
uniform int mode;  // 0: as it is; 1: between low and high; 2: a colour for each value; 3: one channel, as grey; 4: a net of metres; 5: a depth; 6: opaque
layout(location = 0) out vec4 color;
vec3 hue(float h) { return 0.55 + 0.35 * cos(6.2831853 * (h + vec3(0.0, 0.33, 0.67))); }
void main() {
  ivec2 most = textureSize(source, 0) - 1;
  vec4 own = vec4(texelFetch(source, min(ivec2(gl_FragCoord.xy * scale), most), 0));
  vec4 part = (own - low) / max(high - low, vec4(1e-9));
  color = own;
  if (mode == 1) color = vec4(part.rgb, 1.0);
  if (mode == 2) color = own == vec4(0.0) ? vec4(0.0, 0.0, 0.0, 1.0)
    : vec4(hue(fract(dot(own, vec4(0.137, 0.731, 0.0713, 0.0917)))), 1.0);
  if (mode == 3) color = vec4(vec3(part.r), 1.0);
  if (mode == 4) color = own.z <= 0.0 ? vec4(0.0, 0.0, 0.0, 1.0) : vec4(fract(own.xy / high.xy), 0.35, 1.0);
  if (mode == 6) color = vec4(own.rgb, 1.0);
  if (mode == 5) color = vec4(own.r >= 1.0 ? vec3(0.0) : vec3(1.0 + log2(1.0 - own.r) / 14.0), 1.0);
}
`;
const WHOLE = `#version 300 es
void main() { gl_Position = vec4(4.0 * float(gl_VertexID & 1) - 1.0, 2.0 * float(gl_VertexID & 2) - 1.0, 0.0, 1.0); }
`;

/** How a buffer is made visible. */
export interface Shown {
  mode: number;
  low?: readonly number[];
  high?: readonly number[];
}

/** What of some runs lies before an index, or from it on. */
export function halved(runs: readonly Pixels[], at: number, after: boolean): Pixels[] {
  const [least, most] = after ? [at, Infinity] : [0, at];
  return runs
    .map(([first, count]): Pixels => [Math.max(first, least), Math.min(first + count, most) - Math.max(first, least)])
    .filter(([, count]) => count > 0);
}

export class Pipeline {
  private arrays = new Map<string, WebGLVertexArrayObject>();
  private mesh: { vertices: WebGLBuffer; indices: WebGLBuffer } | null = null;
  private held = new Map<string, Held>();
  private images = new Map<string, Held>();
  private frames = new Map<string, WebGLFramebuffer>();
  private sizes: string[] = [];
  /** What each map holds: by which matrix and mesh it was begun, and which passes are over. */
  private kept = new Map<string, { key: string; over: Set<string> }>();
  /** Parts of the mesh and rows of textures that the card has not got yet. */
  private due: { name: string; at: number; end: number }[] = [];
  private version = 0;
  private of: unknown = null;
  private made = 0;

  constructor(private source: Source) {}

  private gl(): WebGL2RenderingContext {
    const gl = context().get();
    if (this.of !== context() || this.made !== context().made) {
      this.forget();
      this.of = context();
      this.made = context().made;
    }
    return gl;
  }

  /** What was made in a context that is lost. */
  private forget(): void {
    this.arrays.clear();
    this.mesh = null;
    for (const map of [this.held, this.images, this.frames, this.kept]) map.clear();
    this.sizes = [];
    this.due = [];
  }

  get passes(): Pass[] {
    return this.source.passes;
  }

  buffer(name: string): Buffer {
    const found = this.source.buffers.find((own) => own.name === name);
    if (!found) throw new Error(`There is no buffer ${name}.`);
    return found;
  }

  sizeOf({ side, part }: Buffer, pixels: Pixels): Pixels {
    return side ? [side, side] : [Math.ceil(pixels[0] / part), Math.ceil(pixels[1] / part)];
  }

  /** Take other shaders, textures or passes; what stays is kept. */
  replace(source: Source): void {
    const gl = context().whyNot ? null : this.gl();
    if (source.vertices.length !== this.source.vertices.length || source.indices.length !== this.source.indices.length)
      this.dropMesh(context().lost ? null : gl);
    else if (source.vertices !== this.source.vertices || source.indices !== this.source.indices)
      for (const name of ["vertices", "indices"]) this.changed(name);
    for (const [name, own] of Object.entries(source.textures)) {
      if (this.source.textures[name]?.content === own.content) continue;
      const old = this.held.get(name);
      if (old && !context().lost) gl?.deleteTexture(old.texture);
      this.held.delete(name);
      this.due = this.due.filter((part) => part.name !== name);
      if (OPENING.includes(name)) this.version += 1;
    }
    this.source = source;
  }

  /** Forget the mesh: there is another one, of another size. */
  private dropMesh(gl: WebGL2RenderingContext | null): void {
    for (const array of this.arrays.values()) gl?.deleteVertexArray(array);
    if (this.mesh) for (const own of Object.values(this.mesh)) gl?.deleteBuffer(own);
    this.arrays.clear();
    this.mesh = null;
    this.due = this.due.filter(({ name }) => name !== "vertices" && name !== "indices");
    this.version += 1;
  }

  /** Say that bytes of vertices, indices or a texture have changed. */
  changed(name: string, at = 0, end = Infinity): void {
    this.due.push({ name, at, end });
    if (name === "vertices" || name === "indices" || OPENING.includes(name)) this.version += 1;
  }

  /** Whether the shaders are there; those that are not are compiled beside the page, where the browser can do so. */
  ready(passes: Pass[] = this.passes): boolean {
    const gl = this.gl();
    if (gl.isContextLost()) return false;
    return passes.map((pass) => ready(gl, this.program(gl, pass))).every(Boolean);
  }

  /** Whether a pass need not run: its maps depend on one matrix, the mesh and its leaves, and these are as they were. */
  fresh(pass: Pass, values: Values): boolean {
    const key = this.keyOf(pass, values);
    const holds = (name: string) => this.kept.get(name)?.key === key && this.kept.get(name)?.over.has(pass.name);
    return key !== "" && pass.writes.every(holds);
  }

  /**
   * Note that a piece of a pass is drawn into its maps; says whether they are to be cleared before. What was begun by the same
   * matrix stays: drawing it again changes nothing, and another view may be about it. What is added to a map of another matrix
   * spoils it, and only its last piece makes a pass whole.
   */
  private note(pass: Pass, values: Values, first: boolean, last: boolean): boolean {
    const key = this.keyOf(pass, values);
    const begins = first && !pass.adds;
    if (key === "") return begins;
    let clears = false;
    for (const name of pass.writes) {
      let own = this.kept.get(name);
      if (own?.key !== key) {
        own = { key: begins ? key : "", over: new Set() };
        clears = begins;
      }
      if (last) own.over.add(pass.name);
      this.kept.set(name, own);
    }
    return clears;
  }

  private keyOf(pass: Pass, values: Values): string {
    if (!pass.through || !pass.writes.every((name) => this.buffer(name).side)) return "";
    return `${this.version} ${Array.from(values[pass.through] as Float64Array)}`;
  }

  /**
   * Run a pass: of the mesh some runs of indices, in the rows from low to high. `first`, `last`: it is that piece of it.
   */
  run(
    pass: Pass,
    values: Values,
    pixels: Pixels,
    piece: { runs?: Pixels[]; rows?: Pixels; first?: boolean; last?: boolean } = {},
  ): void {
    const gl = this.gl();
    if (gl.isContextLost()) return;
    this.upload(gl);
    const size = this.sizeOf(this.buffer(pass.writes[0] as string), pixels);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame(gl, pass, pixels));
    gl.viewport(0, 0, ...size);
    const given = pass.through ? { ...values, from_world: values[pass.through] as Float64Array } : values;
    const program = this.program(gl, pass);
    use(gl, program, given, (name) => this.texture(gl, pass, name, pixels));
    const [low, high] = piece.rows ?? [0, size[1]];
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, low, size[0], high - low);
    if (pass.draws === "mesh") {
      gl.enable(pass.sums ? gl.BLEND : gl.DEPTH_TEST);
      gl.blendFunc(gl.ONE, gl.ONE);
      gl.depthFunc(gl.LESS);
      if (this.note(pass, values, piece.first ?? true, piece.last ?? true)) this.clear(gl, pass);
      if (!pass.both) gl.enable(gl.CULL_FACE);
      gl.bindVertexArray(this.array(gl, pass, program));
      this.draw(gl, halved(piece.runs ?? [], this.source.turning ?? Number.POSITIVE_INFINITY, !!pass.turning));
      gl.bindVertexArray(null);
      for (const state of [gl.CULL_FACE, gl.DEPTH_TEST, gl.BLEND]) gl.disable(state);
    } else if (pass.seen) {
      if (!pass.sky) this.clear(gl, pass);
      gl.enable(gl.DEPTH_TEST);
      gl.depthMask(false);
      gl.depthFunc(pass.sky ? gl.LEQUAL : gl.GREATER); // the screen lies as far away as can be
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      gl.depthMask(true);
      gl.disable(gl.DEPTH_TEST);
    } else gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  /** Draw runs of indices: with one call where the browser can. */
  private draw(gl: WebGL2RenderingContext, runs: Pixels[]): void {
    const many = runs.length > 1 ? gl.getExtension("WEBGL_multi_draw") : null;
    if (many) {
      const counts = Int32Array.from(runs, ([, count]) => count);
      const offsets = Int32Array.from(runs, ([first]) => 4 * first);
      many.multiDrawElementsWEBGL(gl.TRIANGLES, counts, 0, gl.UNSIGNED_INT, offsets, 0, runs.length);
    } else for (const [first, count] of runs) gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 4 * first);
  }

  /** Wait until all that was asked for is drawn: only so is its time known, and a slow picture does not pile up. */
  finish(): void {
    const gl = this.gl();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Make a buffer visible: rows from low to high of it, over the whole of a canvas of `wide` × `tall` pixels. */
  show(
    name: string,
    pixels: Pixels,
    to: CanvasRenderingContext2D,
    shown: Shown = { mode: 6 },
    rows: Pixels | null = null,
    [wide, tall]: Pixels = pixels,
  ): boolean {
    const gl = this.gl();
    const { canvas } = context();
    const image = this.images.get(this.imageKey(name, pixels));
    if (gl.isContextLost() || !image) return false;
    if (canvas.width < wide || canvas.height < tall) {
      canvas.width = Math.max(canvas.width, wide);
      canvas.height = Math.max(canvas.height, tall);
    }
    const scale = [image.size[0] / wide, image.size[1] / tall];
    const [low, high] = rows ?? [0, tall];
    gl.viewport(0, 0, wide, tall);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, low, wide, high - low);
    this.showing(gl, name, image, { scale, ...shown });
    gl.disable(gl.SCISSOR_TEST);
    this.finish();
    if (gl.isContextLost()) return false;
    const [w, h] = [to.canvas.width, to.canvas.height];
    const [y0, y1] = [((tall - high) / tall) * h, ((tall - low) / tall) * h];
    to.clearRect(0, y0, w, y1 - y0);
    to.drawImage(canvas, 0, canvas.height - high, wide, high - low, 0, y0, w, y1 - y0);
    return true;
  }

  /** Values of a buffer, (h, w, 4), row 0 at the bottom, as many as asked for; or of one pixel of it. */
  values(name: string, pixels: Pixels, [wide, tall]: Pixels, at?: Pixels): Float32Array | null {
    const gl = this.gl();
    const image = this.images.get(this.imageKey(name, pixels));
    if (gl.isContextLost() || !image) return null;
    const texture = make(gl, [wide, tall], 4, "f4", null);
    const frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    gl.viewport(0, 0, wide, tall);
    const scale = at ? [2 * at[0] + 1, 2 * at[1] + 1] : [image.size[0] / wide, image.size[1] / tall];
    this.showing(gl, name, image, { mode: 0, scale });
    const found = new Float32Array(4 * wide * tall);
    gl.readPixels(0, 0, wide, tall, gl.RGBA, gl.FLOAT, found);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.deleteFramebuffer(frame);
    gl.deleteTexture(texture);
    return found;
  }

  /** Give back what it holds of the card. */
  free(): void {
    const gl = context().lost || context().whyNot ? null : this.gl();
    if (gl) {
      for (const { texture } of [...this.held.values(), ...this.images.values()]) gl.deleteTexture(texture);
      for (const frame of this.frames.values()) gl.deleteFramebuffer(frame);
      this.dropMesh(gl);
    }
    this.forget();
  }

  private showing(
    gl: WebGL2RenderingContext,
    name: string,
    image: Held,
    { mode, low, high, scale }: Shown & { scale: number[] },
  ): void {
    const whole = this.buffer(name).kind === "i4" ? "isampler2D" : "sampler2D";
    const program = this.named(gl, `show ${whole}`, WHOLE, SHOW.replace("SAMPLER", whole));
    use(gl, program, { mode, scale, low: low ?? [0, 0, 0, 0], high: high ?? [1, 1, 1, 1] }, () => image.texture);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  private program(gl: WebGL2RenderingContext, { name }: Pass): Program {
    const [vertex, fragment] = [`${name}:vertex`, `${name}:fragment`].map((key) => this.source.shaders[key] ?? "");
    return this.named(gl, `${vertex}\0${fragment}`, vertex as string, fragment as string);
  }

  private named(gl: WebGL2RenderingContext, key: string, vertex: string, fragment: string): Program {
    const { programs } = context();
    let found = programs.get(key);
    if (!found) {
      found = begin(gl, vertex, fragment);
      programs.set(key, found);
    }
    return found;
  }

  private array(gl: WebGL2RenderingContext, pass: Pass, { program }: Program): WebGLVertexArrayObject {
    const key = this.source.shaders[`${pass.name}:vertex`] ?? "";
    let found = this.arrays.get(key);
    if (!found) {
      found = gl.createVertexArray() as WebGLVertexArrayObject;
      const mesh = this.mesh as NonNullable<typeof this.mesh>;
      gl.bindVertexArray(found);
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.vertices);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.indices);
      for (const [name, [count, offset]] of Object.entries(this.source.attributes)) {
        const at = gl.getAttribLocation(program, name);
        if (at < 0) continue;
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, count, gl.FLOAT, false, this.source.stride, offset);
      }
      gl.bindVertexArray(null);
      this.arrays.set(key, found);
    }
    return found;
  }

  /** Bring to the card what has changed. */
  private upload(gl: WebGL2RenderingContext): void {
    const { vertices, indices } = this.source;
    if (!this.mesh) {
      this.mesh = { vertices: gl.createBuffer(), indices: gl.createBuffer() };
      gl.bindBuffer(gl.ARRAY_BUFFER, this.mesh.vertices);
      gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
      gl.bindVertexArray(null);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.mesh.indices);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
      this.due = this.due.filter(({ name }) => name !== "vertices" && name !== "indices");
    }
    for (const { name, at, end } of this.due.splice(0)) {
      if (name === "vertices" || name === "indices") {
        const kind = name === "vertices" ? gl.ARRAY_BUFFER : gl.ELEMENT_ARRAY_BUFFER;
        gl.bindBuffer(kind, this.mesh[name]);
        gl.bufferSubData(kind, at, this.source[name], at, Math.min(end, this.source[name].length) - at);
        continue;
      }
      const own = this.source.textures[name];
      const held = this.held.get(name);
      if (!own || !held) continue; // it is made as a whole when it is first read
      const row = own.content.length / own.image.size[1];
      const [low, high] = [Math.floor(at / row), Math.ceil(Math.min(end, own.content.length) / row)];
      gl.bindTexture(gl.TEXTURE_2D, held.texture);
      const { format, type } = formatOf(gl, own.image.channels, own.image.kind);
      const part = typed(own.content.subarray(low * row, high * row), own.image.kind);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, low, own.image.size[0], high - low, format, type, part);
    }
  }

  private texture(gl: WebGL2RenderingContext, pass: Pass, name: string, pixels: Pixels): WebGLTexture | undefined {
    if (pass.reads.includes(name)) return this.image(gl, name, pixels).texture;
    const own = this.source.textures[name];
    if (!own) return undefined;
    let found = this.held.get(name);
    if (!found) {
      const { image, content } = own;
      const texture = make(gl, image.size, image.channels, image.kind, typed(content, image.kind));
      found = { texture, size: image.size };
      this.held.set(name, found);
    }
    return found.texture;
  }

  private imageKey(name: string, pixels: Pixels): string {
    return this.buffer(name).side ? name : `${name} ${pixels.join("×")}`;
  }

  /** The image of a buffer, for pictures of that size. */
  private image(gl: WebGL2RenderingContext, name: string, pixels: Pixels): Held {
    this.makeRoom(gl, pixels);
    const key = this.imageKey(name, pixels);
    let found = this.images.get(key);
    if (!found) {
      const own = this.buffer(name);
      const size = this.sizeOf(own, pixels);
      found = { texture: make(gl, size, own.channels, own.kind, null), size };
      this.images.set(key, found);
    }
    return found;
  }

  /** Few sizes of pictures are kept: the one in motion, and the one at rest. */
  private makeRoom(gl: WebGL2RenderingContext, pixels: Pixels): void {
    const size = pixels.join("×");
    if (this.sizes.at(-1) === size) return;
    this.sizes = [...this.sizes.filter((own) => own !== size), size];
    const gone = this.sizes.length > POOL ? this.sizes.shift() : null;
    if (!gone) return;
    for (const [key, image] of this.images)
      if (key.endsWith(` ${gone}`)) {
        gl.deleteTexture(image.texture);
        this.images.delete(key);
      }
    for (const [key, frame] of this.frames)
      if (key.endsWith(` ${gone}`)) {
        gl.deleteFramebuffer(frame);
        this.frames.delete(key);
      }
  }

  private frame(gl: WebGL2RenderingContext, pass: Pass, pixels: Pixels): WebGLFramebuffer {
    const fixed = pass.writes.every((name) => this.buffer(name).side);
    const key = fixed ? pass.name : `${pass.name} ${pixels.join("×")}`;
    for (const name of pass.seen ? [...pass.writes, pass.seen] : pass.writes) this.image(gl, name, pixels);
    let found = this.frames.get(key);
    if (found) return found;
    found = gl.createFramebuffer() as WebGLFramebuffer;
    gl.bindFramebuffer(gl.FRAMEBUFFER, found);
    const colours: number[] = [];
    for (const name of pass.seen ? [...pass.writes, pass.seen] : pass.writes) {
      const depth = this.buffer(name).kind === "depth";
      const place = depth ? gl.DEPTH_ATTACHMENT : gl.COLOR_ATTACHMENT0 + colours.length;
      gl.framebufferTexture2D(gl.FRAMEBUFFER, place, gl.TEXTURE_2D, this.image(gl, name, pixels).texture, 0);
      if (!depth) colours.push(place);
    }
    gl.drawBuffers(colours.length ? colours : [gl.NONE]);
    const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
    if (status !== gl.FRAMEBUFFER_COMPLETE && !gl.isContextLost())
      throw new Error(
        `This browser cannot draw ${pass.writes.join(", ")} (pass ${pass.name}) in ${pixels.join(" × ")} pixels: ` +
          `framebuffer status ${status}.`,
      );
    this.frames.set(key, found);
    return found;
  }

  private clear(gl: WebGL2RenderingContext, pass: Pass): void {
    let k = 0;
    for (const name of pass.writes) {
      const { kind } = this.buffer(name);
      if (kind === "depth") gl.clearBufferfv(gl.DEPTH, 0, [1]);
      else {
        if (kind === "i4") gl.clearBufferiv(gl.COLOR, k, [0, 0, 0, 0]);
        else gl.clearBufferfv(gl.COLOR, k, [0, 0, 0, 0]);
        k += 1;
      }
    }
  }
}

type Kind = Buffer["kind"];

function formatOf(gl: WebGL2RenderingContext, channels: number, kind: Kind) {
  if (kind === "depth")
    return { inner: gl.DEPTH_COMPONENT24, format: gl.DEPTH_COMPONENT, type: gl.UNSIGNED_INT as number };
  const k = channels === 1 ? 0 : channels === 2 ? 1 : 2; // three channels take four
  const formats = [gl.RED, gl.RG, gl.RGBA];
  const whole = [gl.RED_INTEGER, gl.RG_INTEGER, gl.RGBA_INTEGER];
  const inner = {
    f1: [gl.R8, gl.RG8, gl.RGBA8],
    f2: [gl.R16F, gl.RG16F, gl.RGBA16F],
    f4: [gl.R32F, gl.RG32F, gl.RGBA32F],
    i4: [gl.R32I, gl.RG32I, gl.RGBA32I],
  }[kind][k] as number;
  const type = { f1: gl.UNSIGNED_BYTE, f2: gl.HALF_FLOAT, f4: gl.FLOAT, i4: gl.INT }[kind] as number;
  return { inner, format: (kind === "i4" ? whole : formats)[k] as number, type };
}

/** Bytes as WebGL wants them for a kind of values. */
function typed(bytes: Uint8Array, kind: Kind): ArrayBufferView {
  if (kind === "f1") return bytes;
  const Whole = kind === "f2" ? Uint16Array : Float32Array;
  const whole = bytes.byteOffset % Whole.BYTES_PER_ELEMENT ? bytes.slice() : bytes;
  return new Whole(whole.buffer as ArrayBuffer, whole.byteOffset, whole.byteLength / Whole.BYTES_PER_ELEMENT);
}

function make(
  gl: WebGL2RenderingContext,
  [width, height]: Pixels,
  channels: number,
  kind: Kind,
  content: ArrayBufferView | null,
): WebGLTexture {
  const texture = gl.createTexture() as WebGLTexture;
  const { inner, format, type } = formatOf(gl, channels, kind);
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage2D(gl.TEXTURE_2D, 0, inner, width, height, 0, format, type, content);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  return texture;
}
