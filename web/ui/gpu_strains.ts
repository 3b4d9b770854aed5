import type { Rests } from "../engine/index.ts";
import { Texture, type Graphics, type Target, type Uniform } from "../render/index.ts";
import { asTexels } from "./deformer.ts";
import { floatTarget, Pass, runPasses } from "./gpu_pass.ts";

/** The strains of web/engine/membrane_strain.ts, one vertex per texel. */
const STRAINS = `
uniform sampler2D positions;
uniform isampler2D ranges;
uniform isampler2D pairs;
uniform sampler2DArray rests;
uniform float weights[MOST_RESTS];
uniform int count;
out vec4 result;
ivec2 cell(int vertex) {
  int width = textureSize(positions, 0).x;
  return ivec2(vertex % width, vertex / width);
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 own = texelFetch(positions, at, 0).xyz;
  ivec2 range = texelFetch(ranges, at, 0).xy;
  int width = textureSize(pairs, 0).x;
  vec2 sums = vec2(0.0);
  for (int i = range.x; i < range.x + range.y; i++) {
    ivec2 pair = texelFetch(pairs, ivec2(i % width, i / width), 0).xy;
    ivec2 b = cell(pair.x), c = cell(pair.y);
    vec3 p = texelFetch(positions, b, 0).xyz - own, q = texelFetch(positions, c, 0).xyz - own;
    for (int k = 0; k < count; k++) {
      if (weights[k] == 0.0) continue; // most of many poses
      vec3 o = texelFetch(rests, ivec3(at, k), 0).xyz;
      vec3 u = texelFetch(rests, ivec3(b, k), 0).xyz - o, v = texelFetch(rests, ivec3(c, k), 0).xyz - o;
      float uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
      if (determinant <= 1e-6 * uu * vv) continue;
      float duu = dot(p - u, p + u), dvv = dot(q - v, q + v), duv = dot(p - u, q) + dot(u, q - v);
      vec4 m = vec4(vv * duu - uv * duv, vv * duv - uv * dvv, uu * duv - uv * duu, uu * dvv - uv * duv);
      m *= 0.5 / determinant;
      float area = weights[k] * sqrt(determinant);
      sums += area * vec2(m.x * m.x + m.w * m.w + 2.0 * m.y * m.z, 1.0);
    }
  }
  result = vec4(sums.y > 0.0 ? sqrt(max(sums.x / sums.y, 0.0)) : 0.0, 0.0, 0.0, 1.0);
}`;

/** Strains of a surface on the graphics processor; in the red of each texel. */
export class GpuStrains {
  readonly #graphics: Graphics;
  readonly #pass: Pass;
  readonly #only: readonly Pass[];
  readonly #rests: Texture;
  readonly #set: { weights: Uniform<Float32Array>; count: Uniform<number> };
  #weights: Float32Array | null = null;

  /** `places` has positions, ranges and pairs of a deformer. */
  constructor(
    graphics: Graphics,
    rests: Rests,
    width: number,
    height: number,
    places: Record<string, Uniform>,
  ) {
    this.#graphics = graphics;
    const count = rests.length;
    const texels = new Float32Array(4 * width * height * count);
    rests.forEach((rest, k) => asTexels(rest, texels.subarray(4 * width * height * k)));
    this.#rests = new Texture({ format: "rgba32f", width, height, layers: count, data: texels });
    this.#set = { weights: { value: new Float32Array(count) }, count: { value: count } };
    this.#pass = new Pass(
      graphics,
      STRAINS.replace("MOST_RESTS", String(count)),
      { ...places, rests: { value: this.#rests }, ...this.#set },
      floatTarget(graphics, width, height),
    );
    this.#only = [this.#pass];
  }

  get target(): Target {
    return this.#pass.target;
  }

  get texture(): Texture {
    return this.target.texture;
  }

  /** Weights of the shapes at rest, or null while nothing is asked for. */
  weigh(weights: readonly number[] | null): void {
    this.#weights = weights && Float32Array.from(weights);
  }

  update(): void {
    if (!this.#weights) return;
    [this.#set.weights.value, this.#set.count.value] = [this.#weights, this.#weights.length];
    runPasses(this.#graphics, this.#only);
  }

  dispose(): void {
    this.#rests.dispose();
    this.#pass.dispose();
  }
}
