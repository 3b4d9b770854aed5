// Written by tools/make_core_exports.py from core/online/snapspace_online.h.

/** What web/generated/core.wasm exports; pointers are numbers. */
export interface CoreExports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  malloc(bytes: number): number;
  free(pointer: number): void;
  snapspace_create_posing(
    dimension: number,
    handles: number,
    quartic: number,
    K: number,
    L: number,
    S: number,
    basis: number,
    error: number,
  ): number;
  snapspace_moduli(kind: number): number;
  snapspace_modulus_name(kind: number, modulus: number): number;
  snapspace_value_scale(material: number, tets: number, volumes: number, valueScale: number): number;
  snapspace_displacement_rows(
    tets: number,
    dimension: number,
    points: number,
    modes: number,
    shellModuli: number,
    rows: number,
  ): number;
  snapspace_shell_moduli(
    kind: number,
    elements: number,
    points: number,
    shellModuli: number,
    areaProducts: number,
    moduli: number,
  ): number;
  snapspace_create_posing_cubature(
    dimension: number,
    handles: number,
    cubature: number,
    K: number,
    L: number,
    S: number,
    basis: number,
    error: number,
  ): number;
  snapspace_create_blending(
    dimension: number,
    poses: number,
    quartics: number,
    basis: number,
    error: number,
  ): number;
  snapspace_create_blending_cubature(
    dimension: number,
    poses: number,
    cubature: number,
    corners: number,
    tau: number,
    basis: number,
    error: number,
  ): number;
  snapspace_create_blending_stars(dimension: number, stars: number, basis: number, error: number): number;
  snapspace_destroy(session: number): void;
  snapspace_set_offsets(session: number, offsets: number): number;
  snapspace_set_weights(session: number, weights: number): number;
  snapspace_set_dimension(session: number, dimension: number): number;
  snapspace_dimension(session: number): number;
  snapspace_solve(session: number, options: number, report: number): number;
  snapspace_softest(session: number, curvature: number): number;
  snapspace_step(
    session: number,
    weight: number,
    target: number,
    options: number,
    report: number,
    before: number,
  ): number;
  snapspace_value(session: number, q: number, value: number): number;
  snapspace_get_q(session: number, q: number): number;
  snapspace_set_q(session: number, q: number): number;
  snapspace_get_vertices(session: number, vertices: number): number;
  snapspace_set_probe(session: number, probe: number): number;
  snapspace_set_star_probe(session: number, probe: number): number;
  snapspace_residual(session: number, residual: number): number;
}

export const ERROR = {
  OK: 0,
  BAD_ARGUMENT: -1,
  NOT_FINITE: -2,
  NOT_DEFINITE: -3,
  WRONG_KIND: -4,
  UNKNOWN_MATERIAL: -5,
} as const;

export const METHOD = { NEWTON: 0, BFGS: 1 } as const;

export const STATUS = {
  CONVERGED: 0,
  MAX_ITERATIONS: 1,
  LINE_SEARCH_FAILED: 2,
  ENERGY_NOT_FINITE: 3,
  MAX_EVALUATIONS: 4,
} as const;

/** A struct in the memory of the core: its bytes, and its fields. Pointers are integers. */
export interface Layout {
  readonly size: number;
  readonly fields: Readonly<Record<string, readonly ["int" | "double", number]>>;
}

export const BASIS = {
  size: 12,
  fields: {
    vertices: ["int", 0],
    tau: ["int", 4],
    modes: ["int", 8],
  },
} as const satisfies Layout;

export const OPTIONS = {
  size: 40,
  fields: {
    method: ["int", 0],
    tolerance: ["double", 8],
    valueScale: ["double", 16],
    coordinateScale: ["double", 24],
    maxIterations: ["int", 32],
    maxEvaluations: ["int", 36],
  },
} as const satisfies Layout;

export const REPORT = {
  size: 32,
  fields: {
    status: ["int", 0],
    iterations: ["int", 4],
    evaluations: ["int", 8],
    value: ["double", 16],
    gradientNorm: ["double", 24],
  },
} as const satisfies Layout;

export const MATERIAL = {
  size: 12,
  fields: {
    kind: ["int", 0],
    count: ["int", 4],
    moduli: ["int", 8],
  },
} as const satisfies Layout;

export const CLUSTERS = {
  size: 12,
  fields: {
    count: ["int", 0],
    sizes: ["int", 4],
    modes: ["int", 8],
  },
} as const satisfies Layout;

export const CUBATURE = {
  size: 36,
  fields: {
    tets: ["int", 0],
    rows: ["int", 4],
    weights: ["int", 8],
    materialKind: ["int", 12],
    materialCount: ["int", 16],
    materialModuli: ["int", 20],
    clustersCount: ["int", 24],
    clustersSizes: ["int", 28],
    clustersModes: ["int", 32],
  },
} as const satisfies Layout;

export const STARS = {
  size: 36,
  fields: {
    poses: ["int", 0],
    stars: ["int", 4],
    rows: ["int", 8],
    weights: ["int", 12],
    materialKind: ["int", 16],
    materialCount: ["int", 20],
    materialModuli: ["int", 24],
    origins: ["int", 28],
    forms: ["int", 32],
  },
} as const satisfies Layout;

export const PROBE = {
  size: 72,
  fields: {
    corners: ["int", 0],
    tets: ["int", 4],
    rests: ["int", 8],
    samples: ["int", 12],
    pins: ["int", 16],
    tau: ["int", 20],
    modes: ["int", 24],
    restShapes: ["int", 28],
    tetCorners: ["int", 32],
    materialKind: ["int", 36],
    materialCount: ["int", 40],
    materialModuli: ["int", 44],
    sampled: ["int", 48],
    weights: ["int", 52],
    pinned: ["int", 56],
    pinHandles: ["int", 60],
    pulls: ["int", 64],
    arms: ["int", 68],
  },
} as const satisfies Layout;

export const STAR_PROBE = {
  size: 72,
  fields: {
    stars: ["int", 0],
    rests: ["int", 4],
    samples: ["int", 8],
    parts: ["int", 12],
    pins: ["int", 16],
    origins: ["int", 20],
    modes: ["int", 24],
    materialKind: ["int", 28],
    materialCount: ["int", 32],
    materialModuli: ["int", 36],
    partStars: ["int", 40],
    partSamples: ["int", 44],
    partVectors: ["int", 48],
    weights: ["int", 52],
    pinned: ["int", 56],
    pinHandles: ["int", 60],
    pulls: ["int", 64],
    arms: ["int", 68],
  },
} as const satisfies Layout;
