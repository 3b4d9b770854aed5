import {
  DataArrayTexture,
  DataTexture,
  FloatType,
  RGBAFormat,
  RGBAIntegerFormat,
  ShortType,
  type Texture,
  type WebGLRenderer,
  type WebGLRenderTarget,
} from "three";

import type { Rests, ShapeSpace } from "../engine/index.ts";
import { asTexels, fromTexels, textureSize, type Deformer } from "./deformer.ts";
import { GpuStrains } from "./gpu_strains.ts";
import { floatTarget, integers, Pass, runPasses } from "./gpu_pass.ts";
import { rings } from "./rings.ts";

/** Modes that the shader takes: a WebGL 2 texture has at least so many layers. */
export const MOST_MODES = 256;

/** base + sum_i c_i modes_i, one texel per vertex; mode i is layer i. Then a share of the path to a goal. */
const POSITIONS = `
precision highp float;
precision highp sampler2D;
precision highp isampler2DArray;
uniform sampler2D base;
uniform isampler2DArray modes;
uniform vec4 coefficients[${MOST_MODES / 4}];
uniform int count;
uniform sampler2D goal;
uniform float share;
out vec4 result;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 sum = texelFetch(base, at, 0).xyz;
  for (int i = 0; i < count; i++)
    sum += coefficients[i >> 2][i & 3] * vec3(texelFetch(modes, ivec3(at, i), 0).xyz);
  if (share > 0.0) sum = mix(sum, texelFetch(goal, at, 0).xyz, share);
  result = vec4(sum, 1.0);
}`;

/** The sum of the normals of the faces around a vertex, weighted by area. */
const NORMALS = `
precision highp float;
precision highp sampler2D;
precision highp isampler2D;
uniform sampler2D positions;
uniform isampler2D ranges;
uniform isampler2D pairs;
out vec4 result;
vec3 place(int vertex) {
  int width = textureSize(positions, 0).x;
  return texelFetch(positions, ivec2(vertex % width, vertex / width), 0).xyz;
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 own = texelFetch(positions, at, 0).xyz;
  ivec2 range = texelFetch(ranges, at, 0).xy;
  int width = textureSize(pairs, 0).x;
  vec3 sum = vec3(0.0);
  for (int i = range.x; i < range.x + range.y; i++) {
    ivec2 pair = texelFetch(pairs, ivec2(i % width, i / width), 0).xy;
    sum += cross(place(pair.x) - own, place(pair.y) - own);
  }
  result = vec4(sum, 1.0);
}`;

/** Positions and normals on the graphics processor, and strains where they are asked for. */
export class GpuDeformer implements Deformer {
  readonly width: number;
  readonly #renderer: WebGLRenderer;
  readonly #space: ShapeSpace;
  readonly #rests: Rests | null;
  readonly #positions: Pass;
  readonly #normals: Pass;
  readonly #passes: readonly Pass[];
  readonly #coefficients: Float32Array;
  readonly #goal: DataTexture;
  readonly #ranges: DataTexture;
  readonly #pairs: DataTexture;
  readonly #textures: readonly Texture[];
  #strains: GpuStrains | null = null;

  /** Whether this browser can draw into float textures, and takes so many modes and vertices. */
  static supports(renderer: WebGLRenderer, space: ShapeSpace): boolean {
    return (
      renderer.extensions.has("EXT_color_buffer_float") &&
      space.scales.length <= MOST_MODES &&
      textureSize(6 * space.vertices)[0] <= renderer.capabilities.maxTextureSize
    );
  }

  constructor(renderer: WebGLRenderer, space: ShapeSpace, faces: Uint32Array, rests: Rests | null = null) {
    const [width, height] = textureSize(space.vertices);
    this.width = width;
    this.#renderer = renderer;
    this.#space = space;
    this.#rests = rests;
    this.#coefficients = new Float32Array(MOST_MODES);
    const base = floats(space.base, width, height);
    const modes = layers(space, width, height);
    const around = rings(faces, space.vertices);
    this.#goal = floats(space.base, width, height);
    this.#ranges = integers(around.ranges, width, height);
    this.#pairs = integers(around.pairs, ...textureSize(around.pairs.length / 2));
    this.#textures = [base, this.#goal, modes, this.#ranges, this.#pairs];
    for (const texture of this.#textures) texture.needsUpdate = true;
    const make = (shader: string, textures: Record<string, Texture>) =>
      new Pass(renderer, shader, textures, floatTarget(width, height));
    this.#positions = make(POSITIONS, { base, modes, goal: this.#goal });
    this.#normals = make(NORMALS, this.#places);
    this.#passes = [this.#positions, this.#normals];
    this.update([]);
  }

  get positions(): Texture {
    return this.#positions.target.texture;
  }

  get normals(): Texture {
    return this.#normals.target.texture;
  }

  get strains(): Texture | null {
    return this.#strains?.texture ?? null;
  }

  set goal(positions: Float32Array) {
    asTexels(positions, this.#goal.image.data as Float32Array);
    this.#goal.needsUpdate = true;
  }

  update(coefficients: ArrayLike<number>, share = 0): void {
    const { length } = coefficients;
    for (let i = 0; i < length; i++) this.#coefficients[i] = coefficients[i] * this.#space.scales[i];
    this.#positions.setVectors("coefficients", this.#coefficients, Math.ceil(length / 4));
    this.#positions.setInteger("count", length);
    this.#positions.setFloat("share", share);
    runPasses(this.#renderer, this.#passes);
    this.#strains?.update();
  }

  weigh(weights: readonly number[] | null): void {
    if (weights && !this.#strains && this.#rests) {
      const { width, height } = this.#positions.target;
      this.#strains = new GpuStrains(this.#renderer, this.#rests, width, height, this.#places);
    }
    this.#strains?.weigh(weights);
  }

  read(): Float32Array<ArrayBuffer> {
    return this.#readFrom(this.#positions.target);
  }

  readStrains(): Float32Array {
    const target = this.#strains?.target;
    return target ? this.#readFrom(target).filter((_, i) => i % 3 === 0) : new Float32Array();
  }

  dispose(): void {
    this.#textures.forEach((texture) => texture.dispose());
    for (const pass of this.#passes) {
      pass.target.dispose();
      pass.dispose();
    }
    this.#strains?.dispose();
  }

  /** Positions of the vertices, and their neighbours. */
  get #places(): Record<string, Texture> {
    return { positions: this.positions, ranges: this.#ranges, pairs: this.#pairs };
  }

  #readFrom(target: WebGLRenderTarget): Float32Array<ArrayBuffer> {
    const { width, height } = target;
    const texels = new Float32Array(4 * width * height);
    this.#renderer.readRenderTargetPixels(target, 0, 0, width, height, texels);
    return fromTexels(texels, this.#space);
  }
}

function floats(rows: Float32Array, width: number, height: number): DataTexture {
  const texture = new DataTexture(new Float32Array(4 * width * height), width, height, RGBAFormat, FloatType);
  asTexels(rows, texture.image.data as Float32Array);
  return texture;
}

/** Modes as layers of an array of textures, without a copy in floats. */
function layers(space: ShapeSpace, width: number, height: number): DataArrayTexture {
  const count = space.scales.length;
  const texels = new Int16Array(4 * width * height * count);
  const size = 3 * space.vertices;
  for (let mode = 0; mode < count; mode++)
    for (let from = 0, to = 4 * width * height * mode; from < size; from += 3, to += 4)
      for (let axis = 0; axis < 3; axis++) texels[to + axis] = space.modes[mode * size + from + axis];
  const texture = new DataArrayTexture(texels, width, height, count);
  texture.format = RGBAIntegerFormat;
  texture.type = ShortType;
  texture.internalFormat = "RGBA16I";
  return texture;
}
