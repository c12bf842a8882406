// The only WebGL2 context that pictures have on a page: each is drawn in it, and copied into a canvas of its own. So there
// are never more than browsers allow, and no view goes blank. What a lost one held is made again.

import type { Program } from "./programs.ts";

export class Context {
  readonly canvas = document.createElement("canvas");
  private gl: WebGL2RenderingContext | null = null;
  private readonly watchers = new Set<(lost: boolean) => void>();
  /** How many contexts there have been: what was made in an earlier one is gone. */
  made = 0;
  /** By their sources; all pictures of a page share them. */
  readonly programs = new Map<string, Program>();

  constructor() {
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.tell(true);
    });
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.made += 1;
      this.programs.clear();
      this.tell(false);
    });
  }

  /** Be told when it is lost, and when it has come back, until the signal ends. */
  watch(changed: (lost: boolean) => void, signal: AbortSignal): void {
    this.watchers.add(changed);
    signal.addEventListener("abort", () => this.watchers.delete(changed));
  }

  private tell(lost: boolean): void {
    for (const changed of [...this.watchers]) changed(lost);
  }

  /** It, made when first asked for. Throws where there can be none. */
  get(): WebGL2RenderingContext {
    if (!this.gl) {
      this.gl = this.canvas.getContext("webgl2", { antialias: false, depth: false, alpha: true });
      if (!this.gl) throw new Error("This browser offers no WebGL2, with which pictures are drawn.");
      this.made += 1;
    }
    if (!this.gl.isContextLost() && !this.gl.getExtension("EXT_color_buffer_float"))
      throw new Error("This browser's WebGL2 has no EXT_color_buffer_float, which the picture needs.");
    return this.gl;
  }

  get lost(): boolean {
    return this.gl?.isContextLost() ?? false;
  }

  /** Why nothing can be drawn here; empty if it can. */
  get whyNot(): string {
    try {
      this.get();
      return "";
    } catch (error) {
      return error instanceof Error ? error.message : String(error);
    }
  }

  /** Pixels a side of the largest image that can be had. */
  get largest(): number {
    if (this.lost || this.whyNot) return 1 << 14;
    return (this.get().getParameter(WebGL2RenderingContext.MAX_TEXTURE_SIZE) as number) || 1 << 11;
  }

  /** Why images of a size cannot be had; empty if they can. */
  tooSmall(side: number): string {
    return side <= this.largest
      ? ""
      : `This browser draws from images of at most ${this.largest} pixels a side; this town takes ${side}.`;
  }

  /** Whether it draws without a graphics card: then pictures are copied into canvases in main memory. */
  get software(): boolean {
    try {
      const gl = this.get();
      const names = gl.getExtension("WEBGL_debug_renderer_info");
      return /swiftshader|llvmpipe|softpipe|software/i.test(
        String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER)),
      );
    } catch {
      return true;
    }
  }

  /** Let the browser take it, and give it back: what a driver's reset does. */
  async lose(): Promise<void> {
    const extension = this.get().getExtension("WEBGL_lose_context");
    if (!extension) return;
    extension.loseContext();
    await new Promise((done) => setTimeout(done, 100));
    extension.restoreContext();
  }
}

const KEY = Symbol.for("facade_nb.pipeline.context");
const shared = globalThis as { [KEY]?: Context };

/** The page's. */
export function context(): Context {
  shared[KEY] ??= new Context();
  return shared[KEY];
}
