import type { Material } from "./model.ts";

/** What a model knows about the errors of its frames; as ErrorEstimator of the Python package. */
export interface Estimator {
  /** Mass of the body at density 1: its volume. */
  readonly mass: number;
  readonly probe: ElementProbe | StarProbe;
  /** Frames that were solved in full, d numbers each, and their true distances over size * (residual / size) ^ exponent. */
  readonly coordinates: Float64Array;
  readonly ratios: Float64Array;
  /** 1 in earlier calibrations. */
  readonly exponent: number;
}

/** What core/online/element_probe.h takes. */
export interface ElementProbe {
  readonly kind: "elements";
  /** d x 3 corners: the modes at the corners of the tets around the vertices where residuals are read. */
  readonly modes: Float32Array;
  /** tau at the corners, x0 y0 z0 x1 ... */
  readonly base: Float64Array;
  /** Shapes at rest at the corners: one, or those of all poses. */
  readonly rests: readonly Float64Array[];
  /** Four corners each. */
  readonly tets: Int32Array;
  /** The material of these tets. */
  readonly material: Material;
  /** The corners where residuals are read, and the weights of their squares. */
  readonly places: Int32Array;
  readonly weights: Float64Array;
  /** Pinned vertices among these corners, of posing models. */
  readonly pins: Pins;
}

/** What core/online/star_probe.h takes: numbers are 9 per star, and then 3 per vertex where residuals are read. */
export interface StarProbe {
  readonly kind: "stars";
  /** Poses x numbers, those of tau. */
  readonly origins: Float64Array;
  /** Poses x d x numbers, those of the modes. */
  readonly modes: Float32Array<ArrayBuffer>;
  /** The material: one row for each pose and star. */
  readonly material: Material;
  /** Pairs of a star and a vertex that its stress pulls at, and poses x pairs x 3 what it is multiplied by there. */
  readonly partStars: Int32Array;
  readonly partPlaces: Int32Array;
  readonly partVectors: Float64Array;
  /** The weights of the squared residuals, one per vertex. */
  readonly weights: Float64Array;
  /** Pinned vertices among them, of posing models. */
  readonly pins: Pins;
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

/** From the centroids of their handles to the pinned vertices at rest, 3 numbers each. */
export function armsOf(
  rests: Float64Array,
  owners: Int32Array,
  handles: readonly { readonly center: readonly number[] }[],
): Float64Array {
  return rests.map((x, i) => x - handles[owners[Math.floor(i / 3)]].center[i % 3]);
}

/** Three numbers per vertex, of some vertices. */
export function rowsAt(rows: Float64Array, vertices: ArrayLike<number>): Float64Array {
  return Float64Array.from(
    { length: 3 * vertices.length },
    (_, i) => rows[3 * vertices[Math.floor(i / 3)] + (i % 3)],
  );
}
