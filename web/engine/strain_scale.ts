import { triangleStrains, type Rests } from "./membrane_strain.ts";
import { reconstruct, type ShapeSpace } from "./shape_space.ts";

const TRIANGLES = 500;
const SHARE = 0.97; // share of the triangles below the end of the scale
const LEAST = 0.01;
const USED = 3; // a scale shrinks to a third and less: steps are up to 2.5
const STEPS = [1, 2, 5, 10];

/** Where a scale of strains ends: 1, 2 or 5 times a power of ten above nearly all of a sample of triangles.
 *
 * It grows at once, and shrinks only if less than a third of it is used: it rests in a drag. */
export class StrainScale {
  readonly #space: ShapeSpace;
  readonly #rests: Rests;
  readonly #faces: Uint32Array;
  readonly #shape: Float32Array;
  #end = LEAST;

  /** Copies the sampled triangles from the surface, so that the cost does not grow with it. */
  constructor(space: ShapeSpace, rests: Rests, faces: Uint32Array) {
    const count = faces.length / 3;
    const sampled = Math.min(count, TRIANGLES);
    const corners = Array.from({ length: sampled }, (_, i) => Math.floor((i * count) / sampled)).flatMap(
      (triangle) => [...faces.subarray(3 * triangle, 3 * triangle + 3)],
    );
    const taken = (rows: Float32Array | Int16Array, start = 0) =>
      corners.flatMap((vertex) => [0, 1, 2].map((axis) => rows[start + 3 * vertex + axis]));
    const modes = new Int16Array(3 * corners.length * space.scales.length);
    space.scales.forEach((_, mode) =>
      modes.set(taken(space.modes, mode * space.base.length), 3 * corners.length * mode),
    );
    this.#space = {
      vertices: corners.length,
      base: Float32Array.from(taken(space.base)),
      modes,
      scales: space.scales,
    };
    this.#rests = rests.map((rest) => Float32Array.from(taken(rest)));
    this.#faces = Uint32Array.from(corners, (_, corner) => corner);
    this.#shape = new Float32Array(3 * corners.length);
  }

  /** The end of the scale. */
  get end(): number {
    return this.#end;
  }

  /** Looks at a shape; whether the scale has changed. */
  look(coefficients: ArrayLike<number>, weights: ArrayLike<number>): boolean {
    reconstruct(this.#space, coefficients, this.#shape);
    const strains = triangleStrains(this.#rests, weights, this.#shape, this.#faces).sort();
    const most = strains[Math.floor(SHARE * (strains.length - 1))];
    const before = this.#end;
    if (most > this.#end || USED * most < this.#end) this.#end = roundedUp(Math.max(most, LEAST));
    return this.#end !== before;
  }
}

/** The next 1, 2 or 5 times a power of ten. */
export function roundedUp(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  return power * STEPS.find((step) => value <= step * power * (1 + 1e-9))!;
}
