import { readAppearance } from "./appearance.ts";
import type { Container } from "./container.ts";
import { UnreadableModel } from "./errors.ts";
import { NO_PINS, type ElementProbe, type Estimator, type Pins, type StarProbe } from "./estimator.ts";
import { exponentOf } from "./read_estimator.ts";
import { readLocalRows } from "./read_local_rows.ts";
import { readMaterial } from "./read_material.ts";
import {
  coefficientCount,
  type BlendedStars,
  type BlendingModel,
  type Cubature,
  type Handle,
  type Model,
  type Quartic,
} from "./model.ts";
import { readMirror } from "./mirror.ts";
import type { RigidFrames } from "./rigid_frames.ts";
import type { ShapeSpace } from "./shape_space.ts";

/** Reads the model of an exported page (snapspace/page/pack.py). */
export function readPacked(container: Container): Model {
  const about = JSON.parse(container.header["about"]);
  const [dimension] = container.shape("space_scales", 1);
  const [faceCount] = container.shape("faces", 2);
  const space = readSpace(container, "space");
  const common = {
    name: String(about.name),
    up: about.up as "x" | "y" | "z",
    dimension,
    space,
    faces: Uint32Array.from(container.indices("faces", space.vertices, [faceCount, 3])),
    valueScale: Number(about.value_scale),
    coordinateScale: Number(about.coordinate_scale),
    diagonal: Number(about.diagonal),
    material: String(about.material.model),
    timeline: about.timeline as unknown,
    appearance: readAppearance(container, about.appearance, space.vertices),
  };
  if (container.header["kind"] === "posing") {
    const count = about.handles.length as number;
    return {
      ...common,
      kind: "posing",
      estimator: readEstimator(container, common, about.handles),
      handles: about.handles,
      handleOfVertex: container.indices("handle_of_vertex", count, [space.vertices], -1),
      boxes: about.boxes,
      mirror: readMirror(about.mirror, count),
      elastic: readElastic(container, common),
      K: container.doubles("handle_K", dimension, dimension),
      L: container.doubles("handle_L", count, dimension, 12),
      S: container.doubles("handle_S", count, 4, 4),
      frames: readFrames(container, dimension),
      fromBefore: readFromBefore(container, dimension),
    };
  }
  if (container.header["kind"] !== "interpolation")
    throw new UnreadableModel(
      `This page cannot read models of kind '${container.header["kind"]}'. Export the page again.`,
    );
  const poses = about.poses as string[];
  const [samples] = container.shape("sample_weights", 2);
  return {
    ...common,
    kind: "interpolation",
    estimator: readEstimator(container, common, []),
    poses,
    poseSpace: readSpace(container, "poses"),
    lowestWeight: Number(about.lowest_weight),
    blends: readBlends(container, common, poses.length),
    sampleWeights: container.doubles("sample_weights", samples, poses.length),
    sampleCoordinates: container.doubles("sample_coordinates", samples, dimension),
  };
}

function readFrames(container: Container, dimension: number): RigidFrames | null {
  if (!container.has("frame_modes")) return null;
  return {
    modes: container.floats("frame_modes", 6, dimension, dimension),
    tau: container.doubles("frame_tau", 3, 3, dimension),
    ones: container.doubles("frame_ones", 3, dimension),
  };
}

function readFromBefore(container: Container, dimension: number): Float32Array<ArrayBuffer> | null {
  if (!container.has("from_before")) return null;
  return container.floats("from_before", dimension, container.shape("from_before", 2)[1]);
}

interface Known {
  readonly dimension: number;
  /** The material's name. */
  readonly material: string;
}

function readElastic(container: Container, known: Known): Quartic | Cubature {
  if (container.has("cubature_weights")) return readCubature(container, known);
  return {
    kind: "quartic",
    coefficients: container.doubles("quartic", coefficientCount(known.dimension)),
  };
}

function readCubature(container: Container, { dimension, material }: Known): Cubature {
  const [tets] = container.shape("cubature_weights", 1);
  const local = readLocalRows(container, tets, dimension);
  return {
    kind: "cubature",
    ...(local ?? { rows: container.floats("cubature_rows", tets, 9, dimension), clusters: null }),
    weights: container.doubles("cubature_weights", tets),
    material: readMaterial(container, "cubature_moduli", material),
  };
}

function readBlends(container: Container, known: Known, poses: number): BlendingModel["blends"] {
  if (container.has("stars_rows")) return readStars(container, known, poses);
  if (!container.has("cubature_weights")) {
    const coefficients = container.doubles("quartics", poses, coefficientCount(known.dimension));
    return { kind: "quartics", coefficients };
  }
  const cubature = readCubature(container, known);
  const corners = container.doubles("cubature_corners", poses + 1, cubature.weights.length, 12);
  return { ...cubature, corners };
}

function readStars(container: Container, { dimension, material }: Known, poses: number): BlendedStars {
  const [stars] = container.shape("stars_weights", 1);
  return {
    kind: "stars",
    rows: container.floats("stars_rows", poses, stars, 9, dimension),
    weights: container.doubles("stars_weights", stars),
    material: readMaterial(container, "stars_moduli", material, poses * stars),
    origins: container.doubles("stars_origins", poses, stars, 9),
    forms: container.doubles("stars_forms", poses, dimension + 1, dimension + 1),
    dirichlet: container.doubles("stars_dirichlet", poses, dimension, dimension),
  };
}

function readEstimator(container: Container, known: Known, handles: readonly Handle[]): Estimator | null {
  if (!container.has("estimator_ratios")) return null;
  const [frames] = container.shape("estimator_ratios", 1);
  return {
    mass: container.doubles("estimator_mass", 1)[0],
    probe: container.has("estimator_part_stars")
      ? readStarProbe(container, known, handles)
      : readElementProbe(container, known, handles),
    coordinates: container.doubles("estimator_coordinates", frames, known.dimension),
    ratios: container.doubles("estimator_ratios", frames),
    exponent: exponentOf(container),
  };
}

function readElementProbe(
  container: Container,
  { dimension, material }: Known,
  handles: readonly Handle[],
): ElementProbe {
  const [count, corners] = container.shape("estimator_rests", 3);
  const [tets] = container.shape("estimator_tets", 2);
  const [places] = container.shape("estimator_places", 1);
  const rests = container.doubles("estimator_rests", count, corners, 3);
  return {
    kind: "elements",
    modes: container.floats("estimator_modes", dimension, 3 * corners),
    base: container.doubles("estimator_base", corners, 3),
    rests: Array.from({ length: count }, (_, k) => rests.subarray(3 * corners * k, 3 * corners * (k + 1))),
    tets: container.indices("estimator_tets", corners, [tets, 4]),
    material: readMaterial(container, "estimator_moduli", material),
    places: container.indices("estimator_places", corners, [places]),
    weights: container.doubles("estimator_weights", places),
    pins: readPins(container, handles, corners),
  };
}

function readStarProbe(
  container: Container,
  { dimension, material }: Known,
  handles: readonly Handle[],
): StarProbe {
  const [poses, numbers] = container.shape("estimator_origins", 2);
  const [places] = container.shape("estimator_weights", 1);
  const [parts] = container.shape("estimator_part_stars", 1);
  const stars = (numbers - 3 * places) / 9;
  return {
    kind: "stars",
    origins: container.doubles("estimator_origins", poses, numbers),
    modes: container.floats("estimator_modes", poses, dimension, numbers),
    material: readMaterial(container, "estimator_moduli", material, poses * stars),
    partStars: container.indices("estimator_part_stars", stars, [parts]),
    partPlaces: container.indices("estimator_part_places", places, [parts]),
    partVectors: container.doubles("estimator_part_vectors", poses, parts, 3),
    weights: container.doubles("estimator_weights", places),
    pins: readPins(container, handles, places),
  };
}

/** `known` is how many vertices the probe knows. */
function readPins(container: Container, handles: readonly Handle[], known: number): Pins {
  if (handles.length === 0) return NO_PINS;
  const [count] = container.shape("estimator_pin_corners", 1);
  return {
    corners: container.indices("estimator_pin_corners", known, [count]),
    handles: container.indices("estimator_pin_handles", handles.length, [count]),
    pulls: container.doubles("estimator_pin_pulls", count),
    arms: container.doubles("estimator_pin_arms", count, 3),
  };
}

function readSpace(container: Container, name: string): ShapeSpace {
  const [count, size] = container.shape(`${name}_modes`, 2);
  return {
    vertices: size / 3,
    base: container.floats("base", size),
    modes: container.shorts(`${name}_modes`, count, size),
    scales: container.floats(`${name}_scales`, count),
  };
}
