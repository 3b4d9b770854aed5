import {
  DataTexture,
  FloatType,
  IntType,
  NearestFilter,
  NoBlending,
  RGBAFormat,
  RGIntegerFormat,
  WebGLRenderTarget,
  type Texture,
  type WebGLRenderer,
} from "three";

/** A triangle that covers the target, without attributes: then it does not matter which arrays are bound. */
const VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`;

// Units of textures that materials hardly use: what is bound there stays bound from picture to picture.
const FIRST_UNIT = 8;

/** Pairs of integers, a texel each. */
export function integers(values: Int32Array, width: number, height: number): DataTexture {
  const texels = new Int32Array(2 * width * height);
  texels.set(values);
  const texture = new DataTexture(texels, width, height, RGIntegerFormat, IntType);
  texture.internalFormat = "RG32I";
  return texture;
}

/** What a pass fills: four floats per texel. */
export function floatTarget(width: number, height: number): WebGLRenderTarget {
  return new WebGLRenderTarget(width, height, {
    type: FloatType,
    format: RGBAFormat,
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    depthBuffer: false,
  });
}

/** A computation on the graphics processor: a shader that fills a texture, one texel per item.
 *
 * In WebGL's own calls, past the renderer's scenes and materials, whose work would be several times that of a pass. The
 * renderer's record of what is bound is kept. */
export class Pass {
  readonly target: WebGLRenderTarget;
  readonly #renderer: WebGLRenderer;
  readonly #gl: WebGL2RenderingContext;
  readonly #fragment: string;
  readonly #textures: readonly (readonly [name: string, texture: Texture])[];
  readonly #versions: number[] = [];
  #program: WebGLProgram | null = null;
  #places = new Map<string, WebGLUniformLocation | null>();
  /** Changes when the context was lost: then everything is made again. */
  #made: unknown = null;

  constructor(
    renderer: WebGLRenderer,
    fragment: string,
    textures: Record<string, Texture>,
    target: WebGLRenderTarget,
  ) {
    this.target = target;
    this.#renderer = renderer;
    this.#gl = renderer.getContext() as WebGL2RenderingContext;
    this.#fragment = `#version 300 es\n${fragment.trim()}`;
    this.#textures = Object.entries(textures);
  }

  setInteger(name: string, value: number): void {
    this.#gl.uniform1i(this.#placeOf(name), value);
  }

  setFloat(name: string, value: number): void {
    this.#gl.uniform1f(this.#placeOf(name), value);
  }

  setFloats(name: string, values: Float32Array): void {
    this.#gl.uniform1fv(this.#placeOf(name), values);
  }

  /** The first `count` vectors of four numbers. */
  setVectors(name: string, values: Float32Array, count: number): void {
    if (count > 0) this.#gl.uniform4fv(this.#placeOf(name), values, 0, 4 * count);
  }

  dispose(): void {
    this.#gl.deleteProgram(this.#program);
    this.#program = null;
  }

  /** Fills the target; `runPasses` sets what all passes need. */
  draw(): void {
    const { state } = this.#renderer;
    this.#use();
    this.#renderer.setRenderTarget(this.target); // binds textures when it makes the target
    for (let i = 0; i < this.#textures.length; i++) {
      const texture = this.#textures[i][1];
      if (this.#versions[i] !== texture.version) this.#renderer.initTexture(texture);
      this.#versions[i] = texture.version;
      const kind = "isDataArrayTexture" in texture ? this.#gl.TEXTURE_2D_ARRAY : this.#gl.TEXTURE_2D;
      state.bindTexture(kind, this.#handleOf(texture), this.#gl.TEXTURE0 + FIRST_UNIT + i);
    }
    this.#gl.drawArrays(this.#gl.TRIANGLES, 0, 3);
  }

  #handleOf(texture: Texture): WebGLTexture {
    return (this.#renderer.properties.get(texture) as { __webglTexture: WebGLTexture }).__webglTexture;
  }

  #placeOf(name: string): WebGLUniformLocation | null {
    this.#use();
    if (!this.#places.has(name)) this.#places.set(name, this.#gl.getUniformLocation(this.#program!, name));
    return this.#places.get(name)!;
  }

  #use(): void {
    const { state, properties } = this.#renderer;
    if (this.#program && this.#made === properties) {
      state.useProgram(this.#program);
      return;
    }
    this.#made = properties;
    this.#places.clear();
    this.#versions.length = 0;
    this.#program = linked(this.#gl, this.#fragment);
    state.useProgram(this.#program);
    this.#textures.forEach(([name], i) =>
      this.#gl.uniform1i(this.#gl.getUniformLocation(this.#program!, name), FIRST_UNIT + i),
    );
  }
}

/** Passes one after the other; the renderer then draws to the canvas again. */
export function runPasses(renderer: WebGLRenderer, passes: readonly Pass[]): void {
  const { state } = renderer;
  if (renderer.getContext().isContextLost()) return; // all is drawn again once it is back
  state.setBlending(NoBlending);
  state.buffers.color.setMask(true);
  state.buffers.depth.setTest(false);
  state.disable(renderer.getContext().CULL_FACE);
  for (const pass of passes) pass.draw();
  renderer.setRenderTarget(null);
}

function linked(gl: WebGL2RenderingContext, fragment: string): WebGLProgram {
  const program = gl.createProgram();
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader); // with the program
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`a pass does not link: ${gl.getProgramInfoLog(program)}`);
  return program;
}
