import { LocalRatios } from "./local_ratios.ts";
import type { Model } from "./model.ts";
import { ResidualProbe } from "./residual_probe.ts";

/** Confidence of the bounds. */
export const CONFIDENCE = 0.9;

/** How far a frame is from the full solution, over its distance from the rest or mean shape; as Certificate of the
 * Python package. */
export interface Certificate {
  /** As often too large as too small. */
  readonly relative: number;
  /** Holds with CONFIDENCE; null if the model was calibrated with too few samples for it. */
  readonly upper: number | null;
}

/** Certificates of a model's frames. */
export class Certifier {
  readonly #probe: ResidualProbe;
  readonly #ratios: LocalRatios;
  readonly #mass: number;
  readonly #dimension: number;

  /** Null for a model that was not calibrated. */
  static of(model: Model): Certifier | null {
    return model.estimator ? new Certifier(model, model.estimator) : null;
  }

  private constructor(model: Model, estimator: NonNullable<Model["estimator"]>) {
    this.#probe = new ResidualProbe(estimator, model.material);
    this.#ratios = new LocalRatios(estimator.coordinates, estimator.ratios);
    this.#mass = estimator.mass;
    this.#dimension = model.dimension;
  }

  /** Of the frame q for offsets of handles, or weights of poses; null in fewer dimensions than were calibrated, and
   * at tau itself. */
  certify(q: ArrayLike<number>, state: ArrayLike<number>): Certificate | null {
    // the basis is M-orthonormal: the norm of q is that of the displacement
    const size = Math.hypot(...Array.from(q)) / Math.sqrt(this.#mass);
    if (q.length !== this.#dimension || !(size > 0)) return null;
    const residual = this.#probe.norm(q, state);
    const [middle, bound] = this.#ratios.at(q, CONFIDENCE);
    return {
      relative: (residual * middle) / size,
      upper: bound === null ? null : (residual * bound) / size,
    };
  }
}
