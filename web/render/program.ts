import { ATTRIBUTES } from "./geometry.ts";
import type { Graphics } from "./graphics.ts";
import { Texture } from "./texture.ts";

/** A number, several after each other (column by column for matrices), or a texture. */
export type UniformValue = number | boolean | Iterable<number> | Texture;

/** A uniform whose value may change, and which several materials may share. */
export interface Uniform<Value extends UniformValue = UniformValue> {
  value: Value;
}

type Place = {
  readonly location: WebGLUniformLocation;
  readonly type: number;
  /** The number that it was last set to, or the unit of a texture. */
  number: number | null;
};

/** Two shaders that were linked, with their uniforms. */
export class Program {
  readonly #graphics: Graphics;
  readonly #gl: WebGL2RenderingContext;
  readonly #program: WebGLProgram;
  readonly #places = new Map<string, Place>();

  /** Throws an Error with the compiler's message if the shaders are faulty. */
  constructor(graphics: Graphics, vertex: string, fragment: string) {
    const { gl } = graphics;
    [this.#graphics, this.#gl] = [graphics, gl];
    this.#program = linked(gl, vertex, fragment);
    const count = gl.getProgramParameter(this.#program, gl.ACTIVE_UNIFORMS) ?? 0; // null: the context is lost
    for (let i = 0; i < count; i++) {
      const { name, type } = gl.getActiveUniform(this.#program, i)!;
      const location = gl.getUniformLocation(this.#program, name)!;
      this.#places.set(name.replace("[0]", ""), { location, type, number: null });
    }
  }

  /** Takes the program for what is drawn next. */
  use(): void {
    this.#graphics.use(this.#program);
  }

  /** Sets the uniforms that the shaders read. The program must be in use. */
  set(uniforms: Readonly<Record<string, Uniform>>): void {
    for (const name in uniforms) {
      const place = this.#places.get(name);
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

function linked(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram {
  const program = gl.createProgram();
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, `#version 300 es\n${source.trim()}`);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader); // with the program
  }
  ATTRIBUTES.forEach((name, place) => gl.bindAttribLocation(program, place, name));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`shaders do not link: ${gl.getProgramInfoLog(program)}\n${logs(gl, program)}`);
  return program;
}

function logs(gl: WebGL2RenderingContext, program: WebGLProgram): string {
  return (gl.getAttachedShaders(program) ?? []).map((shader) => gl.getShaderInfoLog(shader)).join("\n");
}
