import { ATTRIBUTES } from "./geometry.ts";
import type { Graphics } from "./graphics.ts";
import { Texture } from "./texture.ts";

/** A number, several after each other (column by column for matrices), or a texture. */
export type UniformValue = number | boolean | Iterable<number> | Texture;

/** A uniform whose value may change, and which several materials may share. */
export interface Uniform<Value extends UniformValue = UniformValue> {
  value: Value;
}

/** Phones may have less by default: 16 bits for whole numbers, and less than those for textures. */
const PRECISION = [
  "float",
  "int",
  "sampler2D",
  "isampler2D",
  "sampler2DArray",
  "isampler2DArray",
  "sampler2DShadow",
]
  .map((type) => `precision highp ${type};\n`)
  .join("");

type Place = {
  readonly location: WebGLUniformLocation;
  readonly type: number;
  /** The number that it was last set to, or the unit of a texture. */
  number: number | null;
};

/** Two linked shaders, with their uniforms.
 *
 * Browsers compile beside the page until they are asked for results, so these are asked for at the first use. */
export class Program {
  readonly #graphics: Graphics;
  readonly #gl: WebGL2RenderingContext;
  readonly #program: WebGLProgram;
  #places: Map<string, Place> | null = null;

  constructor(graphics: Graphics, vertex: string, fragment: string) {
    const { gl } = graphics;
    [this.#graphics, this.#gl] = [graphics, gl];
    this.#program = begun(gl, vertex, fragment);
  }

  /** Selects the program for what is drawn next. Throws an Error with the compiler's message if the shaders are faulty.
   * */
  use(): void {
    this.#places ??= placesOf(this.#gl, this.#program);
    this.#graphics.use(this.#program);
  }

  /** Sets the uniforms that the shaders read. The program must be in use. */
  set(uniforms: Readonly<Record<string, Uniform>>): void {
    for (const name in uniforms) {
      const place = this.#places!.get(name);
      if (place) this.#put(place, uniforms[name].value);
    }
  }

  #put(place: Place, value: UniformValue): void {
    const gl = this.#gl;
    const { location, type } = place;
    if (value instanceof Texture || typeof value === "number" || typeof value === "boolean") {
      const number = value instanceof Texture ? value.bind(this.#graphics) : Number(value);
      if (number === place.number) return;
      place.number = number;
      type === gl.FLOAT ? gl.uniform1f(location, number) : gl.uniform1i(location, number);
    } else {
      const numbers = value as Float32List;
      if (type === gl.FLOAT) gl.uniform1fv(location, numbers);
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(location, numbers);
      else if (type === gl.FLOAT_VEC4) gl.uniform4fv(location, numbers);
      else if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(location, false, numbers);
      else throw new Error(`a uniform of type ${type} cannot be set`);
    }
  }
}

function begun(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram {
  const program = gl.createProgram();
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, `#version 300 es\n${PRECISION}${source}`);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader); // with the program
  }
  ATTRIBUTES.forEach((name, place) => gl.bindAttribLocation(program, place, name));
  gl.linkProgram(program);
  return program;
}

function placesOf(gl: WebGL2RenderingContext, program: WebGLProgram): Map<string, Place> {
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`shaders do not link: ${gl.getProgramInfoLog(program)}\n${logs(gl, program)}`);
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) ?? 0; // null: the context is lost
  const places = new Map<string, Place>();
  for (let i = 0; i < count; i++) {
    const found = gl.getActiveUniform(program, i);
    const location = found && gl.getUniformLocation(program, found.name);
    if (location) places.set(found.name.replace("[0]", ""), { location, type: found.type, number: null });
  }
  return places;
}

function logs(gl: WebGL2RenderingContext, program: WebGLProgram): string {
  return (gl.getAttachedShaders(program) ?? []).map((shader) => gl.getShaderInfoLog(shader)).join("\n");
}
