import type { Core } from "./core.ts";
import type { BlendingModel } from "./model.ts";

/** The reduced energy of training samples for any weights. It is linear in the weights, so each sample is evaluated
 * only once for every pose. As SampleValues of the Python package. */
export class SampleValues {
  readonly dimension: number;
  readonly #core: Core;
  readonly #model: BlendingModel;
  readonly #ofPoses: Float64Array;

  constructor(core: Core, model: BlendingModel) {
    this.dimension = core.dimension;
    this.#core = core;
    this.#model = model;
    this.#ofPoses = new Float64Array(model.sampleWeights.length).fill(NaN);
  }

  /** Energy of a sample; the core must have these weights, and keeps them. */
  at(sample: number, weights: readonly number[]): number {
    const first = sample * weights.length;
    let [sum, isChanged] = [0, false];
    for (const [pose, weight] of weights.entries()) {
      if (weight === 0) continue;
      if (Number.isNaN(this.#ofPoses[first + pose])) {
        this.#core.setWeights(weights.map((_, other) => Number(other === pose)));
        this.#ofPoses[first + pose] = this.#core.value(this.coordinates(sample));
        isChanged = true;
      }
      sum += weight * this.#ofPoses[first + pose];
    }
    if (isChanged) this.#core.setWeights(weights);
    return sum;
  }

  /** Coordinates of a sample, as many as `dimension`. */
  coordinates(sample: number): ArrayLike<number> {
    const first = sample * this.#model.dimension;
    return this.#model.sampleCoordinates.subarray(first, first + this.dimension);
  }
}
