import type { Rests, ShapeSpace } from "../engine/index.ts";
import { Texture, type Graphics, type Target, type Uniform } from "../render/index.ts";
import { fromTexels, putRows, textureSize, type Deformer } from "./deformer.ts";
import { GpuStrains } from "./gpu_strains.ts";
import { floatTarget, integers, Pass, runPasses } from "./gpu_pass.ts";
import { rings } from "./rings.ts";

/** A WebGL 2 texture has at least this many layers. With more modes, several share a layer. */
const MOST_LAYERS = 256;
/** Modes that the shader takes: their coefficients are half of the 224 vectors of uniforms that WebGL 2 promises. */
export const MOST_MODES = 448;

/**
 * base + sum_i c_i modes_i, one texel per vertex. A layer has one mode or several, one below the other. Then a share of
 * the path to a goal.
 */
const POSITIONS = `
uniform sampler2D base;
uniform isampler2DArray modes;
uniform vec4 coefficients[${MOST_MODES / 4}];
uniform int count;
uniform int perLayer;
uniform sampler2D goal;
uniform float share;
out vec4 result;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 sum = texelFetch(base, at, 0).xyz;
  int height = textureSize(base, 0).y;
  for (int layer = 0, i = 0; i < count; layer++)
    for (int y = at.y, end = i + perLayer; i < end && i < count; i++, y += height)
      sum += coefficients[i >> 2][i & 3] * vec3(texelFetch(modes, ivec3(at.x, y, layer), 0).xyz);
  if (share > 0.0) sum = mix(sum, texelFetch(goal, at, 0).xyz, share);
  result = vec4(sum, 1.0);
}`;

/** The sum of the normals of the faces around a vertex, weighted by area. */
const NORMALS = `
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
  readonly #graphics: Graphics;
  readonly #space: ShapeSpace;
  readonly #rests: Rests | null;
  readonly #positions: Pass;
  readonly #normals: Pass;
  readonly #passes: readonly Pass[];
  readonly #coefficients = new Float32Array(MOST_MODES);
  /** Vectors of four, as many as the shape needs. */
  readonly #set = { coefficients: { value: this.#coefficients }, count: { value: 0 }, share: { value: 0 } };
  readonly #goal: Texture;
  readonly #ranges: Texture;
  readonly #pairs: Texture;
  readonly #textures: readonly Texture[];
  #strains: GpuStrains | null = null;

  /** Whether this browser can draw into float textures and can hold all modes and vertices. */
  static supports(graphics: Graphics, space: ShapeSpace): boolean {
    return (
      graphics.canDrawFloats &&
      space.scales.length <= MOST_MODES &&
      textureSize(6 * space.vertices)[0] <= graphics.mostTexels &&
      modesPerLayer(space) * textureSize(space.vertices)[1] <= graphics.mostTexels
    );
  }

  constructor(graphics: Graphics, space: ShapeSpace, faces: Uint32Array, rests: Rests | null = null) {
    const [width, height] = textureSize(space.vertices);
    this.width = width;
    this.#graphics = graphics;
    this.#space = space;
    this.#rests = rests;
    const base = floats(space.base, width, height);
    const modes = layers(space, width, height);
    const around = rings(faces, space.vertices);
    this.#goal = floats(space.base, width, height);
    this.#ranges = integers(around.ranges, width, height);
    this.#pairs = integers(around.pairs, ...textureSize(around.pairs.length / 2));
    this.#textures = [base, this.#goal, modes, this.#ranges, this.#pairs];
    const make = (shader: string, uniforms: Record<string, Uniform>) =>
      new Pass(graphics, shader, uniforms, floatTarget(graphics, width, height));
    const textures = {
      base: { value: base },
      modes: { value: modes },
      perLayer: { value: modesPerLayer(space) },
      goal: { value: this.#goal },
    };
    this.#positions = make(POSITIONS, { ...textures, ...this.#set });
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
    putRows(positions, this.#goal);
  }

  update(coefficients: ArrayLike<number>, share = 0): void {
    const { length } = coefficients;
    for (let i = 0; i < length; i++) this.#coefficients[i] = coefficients[i] * this.#space.scales[i];
    this.#set.coefficients.value = this.#coefficients.subarray(0, Math.max(4 * Math.ceil(length / 4), 4));
    [this.#set.count.value, this.#set.share.value] = [length, share];
    runPasses(this.#graphics, this.#passes);
    this.#strains?.update();
  }

  weigh(weights: readonly number[] | null): void {
    if (weights && !this.#strains && this.#rests) {
      const { width, height } = this.positions;
      this.#strains = new GpuStrains(this.#graphics, this.#rests, width, height, this.#places);
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
    this.#passes.forEach((pass) => pass.dispose());
    this.#strains?.dispose();
  }

  /** Positions of the vertices, and their neighbours. */
  get #places(): Record<string, Uniform> {
    return {
      positions: { value: this.positions },
      ranges: { value: this.#ranges },
      pairs: { value: this.#pairs },
    };
  }

  #readFrom(target: Target): Float32Array<ArrayBuffer> {
    return fromTexels(target.read(), this.#space);
  }
}

function floats(rows: Float32Array, width: number, height: number): Texture {
  const data = new Float32Array(4 * width * height);
  const texture = new Texture({ format: "rgba32f", width, height, data });
  putRows(rows, texture);
  return texture;
}

function modesPerLayer(space: ShapeSpace): number {
  return Math.max(Math.ceil(space.scales.length / MOST_LAYERS), 1);
}

/** Modes in the layers of an array of textures, without a copy in floats. */
function layers(space: ShapeSpace, width: number, height: number): Texture {
  const perLayer = modesPerLayer(space);
  const count = Math.max(Math.ceil(space.scales.length / perLayer), 1); // without modes one that nobody reads
  const texels = new Int16Array(4 * width * height * perLayer * count);
  const size = 3 * space.vertices;
  for (let mode = 0; mode < space.scales.length; mode++)
    for (let from = 0, to = 4 * width * height * mode; from < size; from += 3, to += 4)
      for (let axis = 0; axis < 3; axis++) texels[to + axis] = space.modes[mode * size + from + axis];
  return new Texture({ format: "rgba16i", width, height: perLayer * height, layers: count, data: texels });
}
