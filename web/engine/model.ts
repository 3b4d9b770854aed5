import type { Appearance } from "./appearance.ts";
import type { Box } from "./sampled_box.ts";
import type { Estimator } from "./estimator.ts";
import type { Mirror, NoMirror } from "./mirror.ts";
import type { RigidFrames } from "./rigid_frames.ts";
import type { ShapeSpace } from "./shape_space.ts";

/** What the page needs of a model, whether it came as a model file or in an exported page. */
export type Model = PosingModel | BlendingModel;

interface ModelBase {
  readonly name: string;
  /** Axis that points up at first; missing if the model does not say. */
  readonly up?: "x" | "y" | "z";
  /** d, the number of coordinates. */
  readonly dimension: number;
  /** Triangles of the surface, outward. */
  readonly faces: Uint32Array<ArrayBuffer>;
  /** The surface's shapes tau + U q. */
  readonly space: ShapeSpace;
  /** Units of energy and of q for the termination tests; that of energy may be left to the core. */
  readonly valueScale: number | Body;
  readonly coordinateScale: number;
  /** Diagonal of the mesh at rest, or of the first pose. */
  readonly diagonal: number;
  /** Name of the material. The page knows only the name; the core knows the rest. */
  readonly material: string;
  /** The materials of the user's own file; null without any. */
  readonly appearance: Appearance | null;
  /** Content of a timeline file, if one was saved with the model. */
  readonly timeline?: unknown;
  /** Present in calibrated models. */
  readonly estimator: Estimator | null;
}

/** What tets are made of, as the core takes it: a density by name and its moduli. */
export interface Material {
  readonly kind: string;
  /** Rows of moduli, one for all tets or one per tet. */
  readonly rows: number;
  /** Moduli in the density's order; or by name, if there is one row. */
  readonly moduli: Float64Array<ArrayBuffer> | Readonly<Record<string, unknown>>;
  /** Present for a shell: there are three moduli per row, and the core computes the other numbers from them. */
  readonly shell?: ShellElements;
}

/** Triangles and hinges of a shell at rest. */
export interface ShellElements {
  /** Their corners, elements x 4 x 3; for a blend, those of the first pose. */
  readonly points: Float64Array<ArrayBuffer>;
  /** Four times the product of both areas at which a hinge has its full stiffness: for a blend, the geometric mean of
   * all poses. */
  readonly products: Float64Array<ArrayBuffer>;
}

/** All tets at rest: their volumes, and what they are made of. */
export interface Body {
  readonly volumes: Float64Array;
  readonly material: Material;
}

export interface PosingModel extends ModelBase {
  readonly kind: "posing";
  readonly handles: readonly Handle[];
  /** Index of the handle that a surface vertex belongs to, or -1. */
  readonly handleOfVertex: Int32Array<ArrayBuffer>;
  /** The box of sampled motions, handle by handle; zeros for handles at rest, such as the first one. */
  readonly boxes: readonly Box[];
  /** How poses are mirrored, or why they cannot be. */
  readonly mirror: Mirror | NoMirror;
  readonly elastic: Quartic | Cubature;
  readonly K: Float64Array<ArrayBuffer>;
  readonly L: Float64Array<ArrayBuffer>;
  readonly S: Float64Array<ArrayBuffer>;
  /** What steps in time need where the first handle moves; null in model files. */
  readonly frames: RigidFrames | null;
  /** The modes of the model before in this one, dimension x its dimension, where a server sent that one. */
  readonly fromBefore: Float32Array<ArrayBuffer> | null;
}

/** The exact reduced energy, a polynomial. */
export interface Quartic {
  readonly kind: "quartic";
  readonly coefficients: Float64Array<ArrayBuffer>;
}

/** The energy as a sum over few tets. */
export interface Cubature {
  readonly kind: "cubature";
  /** Displacement gradients of the modes, tets x 9 x dimension, or what the core makes them of; or with clusters those of
   * local coordinates, one cluster after the other, tets x 9 x rank. */
  readonly rows: Float32Array<ArrayBuffer> | CornerModes;
  /** Clusters of tets with local coordinates; null if there are none. */
  readonly clusters: Clusters | null;
  /** The volume that each tet stands for. */
  readonly weights: Float64Array<ArrayBuffer>;
  /** The material of these tets. */
  readonly material: Material;
}

/** Clusters of neighbouring tets, one after the other, each with its own few coordinates. */
export interface Clusters {
  /** Numbers of tets and of local coordinates (rank), clusters x 2. */
  readonly sizes: Int32Array<ArrayBuffer>;
  /** From all coordinates to the local ones, one cluster after the other, rank x dimension. */
  readonly modes: Float32Array<ArrayBuffer>;
}

/** The exact reduced energies of all poses, polynomials. */
export interface PoseQuartics {
  readonly kind: "quartics";
  /** One pose after the other. */
  readonly coefficients: Float64Array<ArrayBuffer>;
}

/** The blended energy as a sum over the same few tets of all poses; rows and weights are those of the first. */
export interface BlendedCubature extends Cubature {
  /** Corners of the tets in every pose, and finally in the mean shape: (poses + 1) x tets x 4 x 3. */
  readonly corners: Float64Array<ArrayBuffer>;
}

/** The blended energy of an as-rigid-as-possible surface: a sum over the same few stars of all poses, and a quadratic
 * form. A star has its own rows, moduli and origin in every pose. */
export interface BlendedStars {
  readonly kind: "stars";
  /** The nine numbers of the modes, poses x stars x 9 x dimension. */
  readonly rows: Float32Array<ArrayBuffer>;
  /** The area in the first pose that each star stands for. */
  readonly weights: Float64Array<ArrayBuffer>;
  /** The material of the stars in all poses, pose by pose. */
  readonly material: Material;
  /** The nine numbers at the mean shape, poses x stars x 9. */
  readonly origins: Float64Array<ArrayBuffer>;
  /** What the stars leave of each pose's energy, poses x (dimension + 1) x (dimension + 1). */
  readonly forms: Float64Array<ArrayBuffer>;
  /** The Dirichlet energies of the poses, q^T D q: poses x dimension x dimension. */
  readonly dirichlet: Float64Array<ArrayBuffer>;
}

/** Positions of the tets' corners at rest, tets x 4 x 3, and the modes there, tets x 4 x 3 x dimension. */
export interface CornerModes {
  readonly points: Float64Array<ArrayBuffer>;
  readonly modes: Float64Array<ArrayBuffer>;
}

export interface Handle {
  readonly name: string;
  /** Mass centroid at rest. */
  readonly center: readonly [number, number, number];
}

export interface BlendingModel extends ModelBase {
  readonly kind: "interpolation";
  readonly poses: readonly string[];
  /** The poses registered to the mean shape, as tau + one mode per pose: with weights that sum to one
   * its shapes are the linear blends. */
  readonly poseSpace: ShapeSpace;
  /** The smallest weight that was sampled. */
  readonly lowestWeight: number;
  readonly blends: PoseQuartics | BlendedCubature | BlendedStars;
  /** Weights and coordinates of the samples that the model was trained with. */
  readonly sampleWeights: Float64Array<ArrayBuffer>;
  readonly sampleCoordinates: Float64Array<ArrayBuffer>;
}

/** C(d + 4, 4), the number of coefficients of a quartic in d variables. */
export function coefficientCount(dimension: number): number {
  return ((dimension + 4) * (dimension + 3) * (dimension + 2) * (dimension + 1)) / 24;
}
