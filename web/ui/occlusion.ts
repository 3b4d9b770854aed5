import { Vector3 } from "three";

import { weightedNormals } from "../engine/index.ts";
import { Target, type Graphics, type Texture } from "../render/index.ts";
import { boxOf } from "./box_of.ts";
import type { Deformer } from "./deformer.ts";
import { floatTarget, integers, Pass, runPasses } from "./gpu_pass.ts";

/** How many patches hide light: the more vertices, the fewer, so that their product is at most this. */
const [FEWEST, MOST] = [128, 384];
const PRODUCT = 1 << 23;
/** Vertices that a patch is computed from. */
const SOME = 64;

/** In the first row the middles of patches, in the second one their areas times their normals. The normals of vertices are
 * twice the areas of their faces, and each face has three corners. */
const PATCHES = `
uniform sampler2D positions;
uniform sampler2D normals;
uniform isampler2D order;
uniform int count;
uniform int size;
out vec4 result;
void main() {
  int first = int(gl_FragCoord.x) * size, end = min(first + size, count), step = 1 + (size - 1) / ${SOME};
  int width = textureSize(positions, 0).x;
  vec3 middle = vec3(0.0), area = vec3(0.0);
  float sum = 1e-30;
  for (int i = first; i < end; i += step) {
    int vertex = texelFetch(order, ivec2(i % width, i / width), 0).x;
    ivec2 at = ivec2(vertex % width, vertex / width);
    vec3 normal = texelFetch(normals, at, 0).xyz;
    middle += length(normal) * texelFetch(positions, at, 0).xyz;
    area += normal;
    sum += length(normal);
  }
  result = vec4(gl_FragCoord.y < 1.0 ? middle / sum : area * float(step) / 6.0, 1.0);
}`;

/** The light that patches leave to vertices. A patch hides as much as a disk (Bunnell 2005); behind several disks it is darker
 * than behind one, but never black. How dark is a matter of taste. The place that is lit is half an edge above the vertex: in a
 * crease a vertex is in the planes of both sides. */
const LIGHT = `
uniform sampler2D positions;
uniform sampler2D normals;
uniform sampler2D patches;
out vec4 result;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 place = texelFetch(positions, at, 0).xyz, normal = texelFetch(normals, at, 0).xyz;
  float size = max(length(normal), 1e-30);
  normal /= size;
  place += 0.2 * sqrt(size) * normal;
  int count = textureSize(patches, 0).x;
  float hidden = 0.0;
  for (int k = 0; k < count; k++) {
    vec3 away = texelFetch(patches, ivec2(k, 0), 0).xyz - place, area = texelFetch(patches, ivec2(k, 1), 0).xyz;
    float square = dot(away, away) + 1e-30;
    float facing = max(dot(normal, away), 0.0) * max(-dot(area, away), 0.0);
    hidden += facing / (square * (3.14159 * square + length(area)));
  }
  result = vec4(exp(-1.5 * hidden));
}`;

/** Ambient occlusion of a shape that changes: the share of light from all sides that reaches each vertex.
 *
 * Per vertex and not per pixel: no halos, no noise, and a shape at rest costs nothing. It is exactly one on convex shapes. */
export class Occlusion {
  readonly #graphics: Graphics;
  readonly #order: Texture;
  readonly #passes: readonly [patches: Pass, light: Pass];

  /** Whether this browser can draw into float textures. */
  static supports(graphics: Graphics): boolean {
    return graphics.canDrawFloats;
  }

  /** `base` is the shape at rest. */
  constructor(graphics: Graphics, { positions, normals }: Deformer, base: Float32Array, faces: Uint32Array) {
    this.#graphics = graphics;
    const count = base.length / 3;
    const most = Math.min(Math.max(Math.floor(PRODUCT / count), FEWEST), MOST, count);
    const size = Math.ceil(count / most);
    const { width, height } = positions;
    const order = new Int32Array(2 * count);
    neighboursTogether(base, faces).forEach((vertex, place) => (order[2 * place] = vertex));
    this.#order = integers(order, width, height);
    const patches = floatTarget(graphics, Math.ceil(count / size), 2);
    const light = new Target(graphics, { format: "r8", width, height });
    const shape = { positions: { value: positions }, normals: { value: normals } };
    const groups = { order: { value: this.#order }, count: { value: count }, size: { value: size } };
    this.#passes = [
      new Pass(graphics, PATCHES, { ...shape, ...groups }, patches),
      new Pass(graphics, LIGHT, { ...shape, patches: { value: patches.texture } }, light),
    ];
  }

  get texture(): Texture {
    return this.#passes[1].target.texture;
  }

  /** Follows the shape that the deformer has. */
  update(): void {
    runPasses(this.#graphics, this.#passes);
  }

  dispose(): void {
    this.#order.dispose();
    this.#passes.forEach((pass) => pass.dispose());
  }
}

/** Vertices in an order in which neighbours that face the same octant are close to each other: along Morton's curve. */
export function neighboursTogether(base: Float32Array, faces: Uint32Array): Int32Array {
  const normals = new Float32Array(base.length);
  weightedNormals(base, faces, normals);
  const box = boxOf(base);
  const least = box.min.toArray();
  const scale = (CELLS - 1) / (Math.max(...box.getSize(new Vector3()).toArray()) || 1);
  // octant, place on the curve, and vertex: exact in 53 bits
  const keys = new Float64Array(base.length / 3);
  for (let vertex = 0, at = 0; vertex < keys.length; vertex++) {
    let [octant, place] = [0, 0];
    for (let axis = 0; axis < 3; axis++, at++) {
      octant = 2 * octant + (normals[at] < 0 ? 1 : 0);
      place = 2 * place + SPREAD[Math.floor(scale * (base[at] - least[axis]))];
    }
    keys[vertex] = (octant * CELLS ** 3 + place) * VERTICES + vertex;
  }
  return Int32Array.from(keys.sort(), (key) => key % VERTICES);
}

const VERTICES = 2 ** 23;
/** Cells of the curve along an axis. */
const CELLS = 2 ** 9;
/** The bits of a cell's number with two zeros between them. */
const SPREAD = Int32Array.from({ length: CELLS }, (_, cell) => parseInt(cell.toString(2), 8));
