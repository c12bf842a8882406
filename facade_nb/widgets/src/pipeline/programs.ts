// Programs of WebGL2: compiled beside the page where the browser can, and given values by the names of their uniforms.

import type { Value, Values } from "./types.ts";

interface Uniform {
  at: WebGLUniformLocation;
  type: number;
}

export interface Program {
  program: WebGLProgram;
  shaders: WebGLShader[];
  uniforms: Map<string, Uniform> | null;
}

/** A program that may still be compiled. */
export function begin(gl: WebGL2RenderingContext, vertex: string, fragment: string): Program {
  const program = gl.createProgram();
  const kinds = [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const;
  const shaders = kinds.map(([kind, source]) => {
    const shader = gl.createShader(kind) as WebGLShader;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    return shader;
  });
  gl.linkProgram(program);
  return { program, shaders, uniforms: null };
}

export function ready(gl: WebGL2RenderingContext, { program, uniforms }: Program): boolean {
  if (uniforms) return true;
  const parallel = gl.getExtension("KHR_parallel_shader_compile");
  return !parallel || gl.getProgramParameter(program, parallel.COMPLETION_STATUS_KHR) !== false;
}

/** Its uniforms; throws what the compiler says of a faulty one. */
function finish(gl: WebGL2RenderingContext, own: Program): Map<string, Uniform> {
  if (own.uniforms) return own.uniforms;
  if (!gl.getProgramParameter(own.program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const told = [...own.shaders.map((one) => gl.getShaderInfoLog(one)), gl.getProgramInfoLog(own.program)];
    throw new Error(`The shader does not compile: ${told.filter(Boolean).join("\n")}`);
  }
  own.uniforms = new Map();
  const count = gl.getProgramParameter(own.program, gl.ACTIVE_UNIFORMS) ?? 0;
  for (let k = 0; k < count; k += 1) {
    const told = gl.getActiveUniform(own.program, k);
    const at = told && gl.getUniformLocation(own.program, told.name);
    if (told && at) own.uniforms.set(told.name.replace(/\[0\]$/, ""), { at, type: told.type });
  }
  return own.uniforms;
}

/** Take a program into use with its values and textures, those that it asks for. */
export function use(
  gl: WebGL2RenderingContext,
  own: Program,
  values: Values,
  texture: (name: string) => WebGLTexture | undefined,
): void {
  const uniforms = finish(gl, own);
  gl.useProgram(own.program);
  const samplers: [WebGLUniformLocation, WebGLTexture | null][] = [];
  for (const [name, { at, type }] of uniforms) {
    if (type === gl.SAMPLER_2D || type === gl.INT_SAMPLER_2D) samplers.push([at, texture(name) ?? null]);
    else {
      const value = values[name];
      if (value !== undefined) give(gl, at, type, value);
    }
  }
  // A texture that is made only now is bound while it is filled: so all are there before any is bound for good.
  samplers.forEach(([at, read], unit) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, read);
    gl.uniform1i(at, unit);
  });
}

function give(gl: WebGL2RenderingContext, at: WebGLUniformLocation, type: number, value: Value): void {
  const list = typeof value === "number" ? [value] : value;
  if (type === gl.FLOAT) gl.uniform1f(at, list[0] as number);
  else if (type === gl.FLOAT_VEC2) gl.uniform2fv(at, list as number[]);
  else if (type === gl.FLOAT_VEC3) gl.uniform3fv(at, list as number[]);
  else if (type === gl.FLOAT_VEC4) gl.uniform4fv(at, list as number[]);
  else if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(at, true, Float32Array.from(list));
  else if (type === gl.INT) gl.uniform1i(at, list[0] as number);
}
