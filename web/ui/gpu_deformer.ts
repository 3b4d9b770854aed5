import {
  BufferAttribute,
  BufferGeometry,
  Camera,
  DataArrayTexture,
  DataTexture,
  FloatType,
  GLSL3,
  IntType,
  Mesh,
  NearestFilter,
  RawShaderMaterial,
  RGBAFormat,
  RGBAIntegerFormat,
  RGIntegerFormat,
  ShortType,
  WebGLRenderTarget,
  type Texture,
  type WebGLRenderer,
} from "three";

import type { ShapeSpace } from "../engine/index.ts";
import { asTexels, fromTexels, textureSize, type Deformer } from "./deformer.ts";
import { rings } from "./rings.ts";

/** Modes that the shader takes: a WebGL 2 texture has at least so many layers. */
export const MOST_MODES = 256;

const VERTEX = `
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }`;

/** base + sum_i c_i modes_i, one texel per vertex; mode i is layer i. */
const POSITIONS = `
precision highp float;
precision highp sampler2D;
precision highp isampler2DArray;
uniform sampler2D base;
uniform isampler2DArray modes;
uniform vec4 coefficients[${MOST_MODES / 4}];
uniform int count;
out vec4 result;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 sum = texelFetch(base, at, 0).xyz;
  for (int i = 0; i < count; i++)
    sum += coefficients[i >> 2][i & 3] * vec3(texelFetch(modes, ivec3(at, i), 0).xyz);
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

/** Positions and normals on the graphics processor. */
export class GpuDeformer implements Deformer {
  readonly width: number;
  readonly #renderer: WebGLRenderer;
  readonly #space: ShapeSpace;
  readonly #targets: WebGLRenderTarget[];
  readonly #passes: Mesh<BufferGeometry, RawShaderMaterial>[];
  readonly #textures: Texture[];
  readonly #camera = new Camera();

  /** Whether this browser can draw into float textures, and takes so many modes and vertices. */
  static supports(renderer: WebGLRenderer, space: ShapeSpace): boolean {
    return (
      renderer.extensions.has("EXT_color_buffer_float") &&
      space.scales.length <= MOST_MODES &&
      textureSize(6 * space.vertices)[0] <= renderer.capabilities.maxTextureSize
    );
  }

  constructor(renderer: WebGLRenderer, space: ShapeSpace, faces: Uint32Array) {
    const [width, height] = textureSize(space.vertices);
    this.width = width;
    this.#renderer = renderer;
    this.#space = space;
    this.#targets = [0, 1].map(
      () =>
        new WebGLRenderTarget(width, height, {
          type: FloatType,
          format: RGBAFormat,
          minFilter: NearestFilter,
          magFilter: NearestFilter,
          depthBuffer: false,
        }),
    );
    const base = new DataTexture(new Float32Array(4 * width * height), width, height, RGBAFormat, FloatType);
    asTexels(space.base, base.image.data as Float32Array);
    const modes = layers(space, width, height);
    const around = rings(faces, space.vertices);
    const ranges = integers(around.ranges, width, height);
    const pairs = integers(around.pairs, ...textureSize(around.pairs.length / 2));
    this.#textures = [base, modes, ranges, pairs];
    for (const texture of this.#textures) texture.needsUpdate = true;
    const coefficients = new Float32Array(MOST_MODES);
    this.#passes = [
      pass(POSITIONS, {
        base: { value: base },
        modes: { value: modes },
        coefficients: { value: coefficients },
        count: { value: 0 },
      }),
      pass(NORMALS, {
        positions: { value: this.positions },
        ranges: { value: ranges },
        pairs: { value: pairs },
      }),
    ];
    this.update([]);
  }

  get positions(): Texture {
    return this.#targets[0].texture;
  }

  get normals(): Texture {
    return this.#targets[1].texture;
  }

  update(coefficients: ArrayLike<number>): void {
    const { uniforms } = this.#passes[0].material;
    for (let i = 0; i < coefficients.length; i++)
      uniforms.coefficients.value[i] = coefficients[i] * this.#space.scales[i];
    uniforms.count.value = coefficients.length;
    const { autoClear } = this.#renderer;
    const shadows = this.#renderer.shadowMap.autoUpdate;
    this.#renderer.autoClear = false;
    this.#renderer.shadowMap.autoUpdate = false;
    this.#passes.forEach((mesh, i) => {
      this.#renderer.setRenderTarget(this.#targets[i]);
      this.#renderer.render(mesh, this.#camera);
    });
    this.#renderer.setRenderTarget(null);
    this.#renderer.autoClear = autoClear;
    this.#renderer.shadowMap.autoUpdate = shadows;
  }

  read(): Float32Array {
    const { width, height } = this.#targets[0];
    const texels = new Float32Array(4 * width * height);
    this.#renderer.readRenderTargetPixels(this.#targets[0], 0, 0, width, height, texels);
    return fromTexels(texels, this.#space);
  }

  dispose(): void {
    this.#targets.forEach((target) => target.dispose());
    this.#textures.forEach((texture) => texture.dispose());
    for (const mesh of this.#passes) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
  }
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

/** Pairs of integers, a texel each. */
function integers(values: Int32Array, width: number, height: number): DataTexture {
  const texels = new Int32Array(2 * width * height);
  texels.set(values);
  const texture = new DataTexture(texels, width, height, RGIntegerFormat, IntType);
  texture.internalFormat = "RG32I";
  return texture;
}

function pass(
  fragmentShader: string,
  uniforms: RawShaderMaterial["uniforms"],
): Mesh<BufferGeometry, RawShaderMaterial> {
  const triangle = new BufferGeometry();
  triangle.setAttribute(
    "position",
    new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3),
  );
  const material = new RawShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader,
    uniforms,
    glslVersion: GLSL3,
    depthTest: false,
    depthWrite: false,
  });
  const mesh = new Mesh(triangle, material);
  mesh.frustumCulled = false;
  return mesh;
}
