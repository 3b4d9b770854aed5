import { readAppearance } from "./appearance.ts";
import type { Container } from "./container.ts";
import { UnreadableModel } from "./errors.ts";
import { NO_PINS } from "./estimator.ts";
import { NO_MIRROR } from "./mirror.ts";
import { estimatorOf, pinsOf } from "./read_estimator.ts";
import {
  coefficientCount,
  type BlendedCubature,
  type CornerModes,
  type Cubature,
  type Handle,
  type Material,
  type Model,
  type PoseQuartics,
  type Quartic,
} from "./model.ts";
import { fileBody, scalesOfTets } from "./read_body.ts";
import { fileMaterial, materialOfTets } from "./read_material.ts";
import { paintedOwners, readRecord, timelineOf, upOf } from "./read_record.ts";
import { registered } from "./registration.ts";
import { boxesOf } from "./sampled_box.ts";
import { quantised } from "./shape_space.ts";
import { ownSurface } from "./read_surface.ts";
import { tetVolumes } from "./tets.ts";

/** Reads a .snapspace file (snapspace/model_file); `name` is shown where the file has none. */
export function readFile(container: Container, name: string): Model {
  const kind = container.header["kind"] ?? "posing"; // the first files had only one
  if (kind === "posing" || kind === "posing-cubature" || kind === "posing-shell")
    return readPosing(container, name);
  if (kind === "interpolation-shell") {
    const { material } = JSON.parse(container.header["problem"]);
    const what = material.model === "arap" ? "surfaces that are as rigid as possible" : "shells";
    throw new UnreadableModel(`This is a model of blended ${what}. Open it with \`snapspace view FILE\`.`);
  }
  if (kind === "interpolation" || kind === "interpolation-cubature")
    return readInterpolation(container, name);
  throw new UnreadableModel(
    `This page cannot read models of kind '${kind}'. Open it with the version of Snapspace that wrote it.`,
  );
}

function readPosing(container: Container, name: string): Model {
  const about = JSON.parse(container.header["problem"]);
  if (container.has("triangles") && about.material.model === "arap")
    throw new UnreadableModel(
      "This is a model of a surface that is as rigid as possible. Open it with `snapspace view FILE`.",
    );
  const [dimension] = container.shape("basis", 2);
  const [vertices] = container.shape("vertices", 2);
  const body = fileBody(container, about.material);
  const { rest, elements, masses, material } = body;
  const basis = container.doubles("basis", dimension, 3 * vertices);
  const count = about.handles.length as number;
  const [pinned] = container.shape("handle_vertices", 1);
  const members = container.indices("handle_vertices", vertices, [pinned]);
  const sizes = container.indices("handle_sizes", pinned + 1, [count]);

  const handleOf = new Int32Array(vertices).fill(-1);
  const handles: Handle[] = [];
  for (let handle = 0, start = 0; handle < count; start += sizes[handle++]) {
    const own = members.subarray(start, start + sizes[handle]);
    own.forEach((vertex) => (handleOf[vertex] = handle));
    handles.push({ name: String(about.handles[handle]), center: centroid(own, rest, masses) });
  }

  const { faces, nearest, embedded } = container.has("surface_faces")
    ? ownSurface(container, vertices)
    : body.surface();
  const record = readRecord(container);
  const names = handles.map((handle) => handle.name);
  return {
    kind: "posing",
    name,
    ...upOf(record, about.surface_source?.name),
    ...timelineOf(record),
    dimension,
    faces,
    appearance: readAppearance(container, about.appearance, nearest.length),
    space: quantised(embedded(rest), embedded(basis)),
    ...body.scales,
    material: material.kind,
    estimator: estimatorOf(
      container,
      { tets: elements, basis, tau: rest, rests: [rest], material },
      (corners, isSampled) =>
        pinsOf(corners, isSampled, { handleOf, handles, rest, masses, stiffness: Number(about.stiffness) }),
    ),
    handles,
    handleOfVertex:
      paintedOwners(record, names, nearest.length) ?? Int32Array.from(nearest, (vertex) => handleOf[vertex]),
    boxes: boxesOf(about.domain, count),
    mirror: NO_MIRROR,
    elastic: readElastic(container, rest, elements, basis, material),
    K: container.doubles("handle_K", dimension, dimension),
    L: container.doubles("handle_L", count, dimension, 12),
    S: container.doubles("handle_S", count, 4, 4),
    frames: null,
    fromBefore: null,
  };
}

function readInterpolation(container: Container, name: string): Model {
  const about = JSON.parse(container.header["problem"]);
  const poses = about.poses as string[];
  const [dimension] = container.shape("basis", 2);
  const [, vertices] = container.shape("poses", 3);
  const [tetCount] = container.shape("tets", 2);
  const [samples] = container.shape("training_parameters", 2);
  const tets = container.indices("tets", vertices, [tetCount, 4]);
  const mean = container.doubles("mean_shape", 3 * vertices);
  const shapes = container.doubles("poses", poses.length, vertices, 3);
  const { faces, embedded } = ownSurface(container, vertices);

  const meanVolumes = tetVolumes(mean, tets);
  const offsets = new Float64Array(shapes.length); // of the registered poses from the mean shape
  for (let pose = 0; pose < poses.length; pose++) {
    const start = 3 * vertices * pose;
    const moved = registered(shapes.subarray(start, start + 3 * vertices), mean, tets, meanVolumes);
    offsets.set(
      moved.map((x, i) => x - mean[i]),
      start,
    );
  }

  const pose = (k: number) => shapes.subarray(3 * vertices * k, 3 * vertices * (k + 1));
  const first = pose(0);
  const basis = container.doubles("basis", dimension, 3 * vertices);
  const registeredPoses = poses.map((_, pose) => mean.map((x, i) => x + offsets[3 * vertices * pose + i]));
  const base = embedded(mean);
  const material = fileMaterial(container, about.material, tetCount);
  return {
    kind: "interpolation",
    name,
    ...upOf(readRecord(container), about.surface_source?.name),
    ...timelineOf(readRecord(container)),
    dimension,
    faces,
    appearance: readAppearance(container, about.appearance, base.length / 3),
    space: quantised(base, embedded(basis)),
    ...scalesOfTets(material, tetVolumes(first, tets), first),
    material: material.kind,
    estimator: estimatorOf(
      container,
      { tets, basis, tau: mean, rests: registeredPoses, material },
      () => NO_PINS,
    ),
    poses,
    poseSpace: quantised(base, embedded(offsets)),
    lowestWeight: -about.extrapolation / poses.length,
    blends: readBlends(container, [...poses.map((_, k) => pose(k)), mean], tets, basis, material),
    sampleWeights: container.doubles("training_parameters", samples, poses.length),
    sampleCoordinates: container.doubles("training_coordinates", samples, dimension),
  };
}

function readElastic(
  container: Container,
  rest: Float64Array,
  tets: Int32Array,
  basis: Float64Array,
  material: Material,
): Quartic | Cubature {
  if (container.has("cubature_tets")) return readCubature(container, rest, tets, basis, material);
  const dimension = basis.length / rest.length;
  return {
    kind: "quartic",
    coefficients: container.doubles("quartic", coefficientCount(dimension)),
  };
}

/** Energies relative to the poses and, last, to the mean shape. */
function readBlends(
  container: Container,
  shapes: readonly Float64Array[],
  tets: Int32Array,
  basis: Float64Array,
  material: Material,
): PoseQuartics | BlendedCubature {
  if (!container.has("cubature_tets")) {
    const dimension = basis.length / shapes[0].length;
    const coefficients = container.doubles("quartics", shapes.length - 1, coefficientCount(dimension));
    return { kind: "quartics", coefficients };
  }
  const cubature = readCubature(container, shapes[0], tets, basis, material);
  const [count] = container.shape("cubature_tets", 1);
  const chosen = container.indices("cubature_tets", tets.length / 4, [count]);
  const corners = new Float64Array(12 * count * shapes.length);
  shapes.forEach((shape, k) => corners.set(cornersOf(shape, tets, chosen), 12 * count * k));
  return { ...cubature, corners };
}

function readCubature(
  container: Container,
  rest: Float64Array,
  tets: Int32Array,
  basis: Float64Array,
  material: Material,
): Cubature {
  const [count] = container.shape("cubature_tets", 1);
  const chosen = container.indices("cubature_tets", tets.length / 4, [count]);
  return {
    kind: "cubature",
    rows: cornerModes(rest, tets, basis, chosen),
    weights: container.doubles("cubature_weights", count),
    material: materialOfTets(material, chosen),
  };
}

function cornerModes(
  rest: Float64Array,
  tets: Int32Array,
  basis: Float64Array,
  chosen: Int32Array,
): CornerModes {
  const dimension = basis.length / rest.length;
  const points = cornersOf(rest, tets, chosen);
  const modes = new Float64Array(points.length * dimension);
  for (let mode = 0; mode < dimension; mode++) {
    const shape = basis.subarray(mode * rest.length, (mode + 1) * rest.length);
    cornersOf(shape, tets, chosen).forEach((x, i) => (modes[i * dimension + mode] = x));
  }
  return { points, modes };
}

/** The parts of a shape (3n) at the corners of some tets, tets x 4 x 3. */
function cornersOf(shape: Float64Array, tets: Int32Array, chosen: Int32Array): Float64Array<ArrayBuffer> {
  const corners = new Float64Array(12 * chosen.length);
  for (let i = 0; i < corners.length; i++) {
    const corner = Math.floor(i / 3);
    corners[i] = shape[3 * tets[4 * chosen[corner >> 2] + (corner & 3)] + (i % 3)];
  }
  return corners;
}

function centroid(members: Int32Array, rest: Float64Array, masses: Float64Array): [number, number, number] {
  const sum = [0, 0, 0, 0];
  for (const vertex of members) {
    for (let axis = 0; axis < 3; axis++) sum[axis] += masses[vertex] * rest[3 * vertex + axis];
    sum[3] += masses[vertex];
  }
  return [sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]];
}
