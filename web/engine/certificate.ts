import type { Core } from "./core.ts";
import { LocalRatios } from "./local_ratios.ts";
import type { Model } from "./model.ts";

/** Confidence of the bounds. */
export const CONFIDENCE = 0.9;
/** Displacements below this share of the calibrated ones count as rest, where a frame has no error. */
const REST = 1e-3;

/** How far a frame is from the full solution, over its distance from the rest or mean shape; as Certificate of the
 * Python package. */
export interface Certificate {
  /** An estimate that is too large as often as too small. */
  readonly relative: number;
  /** Holds with CONFIDENCE; null if the model was calibrated with too few samples for it. */
  readonly upper: number | null;
}

/** Certificates of a model's frames. */
export class Certifier {
  readonly #core: Core;
  readonly #ratios: LocalRatios;
  readonly #mass: number;
  readonly #rest: number;
  readonly #dimension: number;
  readonly #exponent: number;

  /** Null for a model that was not calibrated. `core` solves it. */
  static of(model: Model, core: Core): Certifier | null {
    return model.estimator ? new Certifier(model, core, model.estimator) : null;
  }

  private constructor(model: Model, core: Core, estimator: NonNullable<Model["estimator"]>) {
    this.#core = core;
    this.#ratios = new LocalRatios(estimator.coordinates, estimator.ratios);
    this.#mass = estimator.mass;
    this.#dimension = model.dimension;
    this.#exponent = estimator.exponent;
    const squares = estimator.coordinates.reduce((sum, x) => sum + x * x, 0);
    this.#rest = REST * Math.sqrt(squares / (estimator.ratios.length * estimator.mass));
  }

  /** The certificate of the core's present frame; null in fewer dimensions than were calibrated, at rest, and where the energy is
   * infinite. */
  certify(): Certificate | null {
    const { q } = this.#core;
    // the basis is M-orthonormal: the norm of q is that of the displacement
    const size = Math.hypot(...Array.from(q)) / Math.sqrt(this.#mass);
    if (q.length !== this.#dimension || !(size > this.#rest)) return null;
    const residual = this.#core.residual();
    if (residual === null || !Number.isFinite(residual)) return null;
    const [middle, bound] = this.#ratios.at(q, CONFIDENCE);
    const indicator = (residual / size) ** this.#exponent; // over size
    return { relative: indicator * middle, upper: bound === null ? null : indicator * bound };
  }
}
