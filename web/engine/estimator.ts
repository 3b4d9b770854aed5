import type { Material } from "./model.ts";

/** What a model knows about the errors of its frames; as ErrorEstimator of the Python package, with what core/online/residual_probe.h takes. */
export interface Estimator {
  /** Mass of the body at density 1: its volume. */
  readonly mass: number;
  /** d x 3 corners: the modes at the corners of the tets around the vertices where residuals are read. */
  readonly modes: Float32Array;
  /** tau at the corners, x0 y0 z0 x1 ... */
  readonly base: Float64Array;
  /** Shapes at rest at the corners: one, or those of all poses. */
  readonly rests: readonly Float64Array[];
  /** Four corners each. */
  readonly tets: Int32Array;
  /** Of these tets. */
  readonly material: Material;
  /** The corners where residuals are read, and what their squares count. */
  readonly places: Int32Array;
  readonly weights: Float64Array;
  /** Pinned vertices among these corners, of posing models. */
  readonly pins: Pins;
  /** Frames that were solved in full, d numbers each, and their true distances over size * (residual / size) ^ exponent. */
  readonly coordinates: Float64Array;
  readonly ratios: Float64Array;
  /** 1 in earlier calibrations. */
  readonly exponent: number;
}

export interface Pins {
  readonly corners: Int32Array;
  readonly handles: Int32Array;
  /** Twice the weights of their springs. */
  readonly pulls: Float64Array;
  /** From the handle's centroid at rest, 3 numbers each. */
  readonly arms: Float64Array;
}

export const NO_PINS: Pins = {
  corners: new Int32Array(),
  handles: new Int32Array(),
  pulls: new Float64Array(),
  arms: new Float64Array(),
};

/** From the centroids of their handles to the pinned corners at rest. */
export function armsOf(
  corners: Int32Array,
  owners: Int32Array,
  handles: readonly { readonly center: readonly number[] }[],
  rest: Float64Array,
): Float64Array {
  const arms = new Float64Array(3 * corners.length);
  arms.forEach((_, i) => {
    const [pin, axis] = [Math.floor(i / 3), i % 3];
    arms[i] = rest[3 * corners[pin] + axis] - handles[owners[pin]].center[axis];
  });
  return arms;
}
