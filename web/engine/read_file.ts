import { readAppearance } from "./appearance.ts";
import type { Container } from "./container.ts";
import { UnreadableModel } from "./errors.ts";
import { NO_PINS } from "./estimator.ts";
import { NO_MIRROR } from "./mirror.ts";
import { estimatorOf, pinsOf } from "./read_estimator.ts";
import type { Handle, Model } from "./model.ts";
import { fileBody } from "./read_body.ts";
import { fileElastic, fileBlends } from "./read_elastic.ts";
import { paintedOwners, readRecord, timelineOf, upOf } from "./read_record.ts";
import { registered } from "./registration.ts";
import { boxesOf } from "./sampled_box.ts";
import { quantised } from "./shape_space.ts";
import { withRemainder } from "./read_stars.ts";
import { ownSurface } from "./read_surface.ts";

const POSING = ["posing", "posing-cubature", "posing-shell"];
const BLENDING = ["interpolation", "interpolation-cubature", "interpolation-shell"];

/** Reads a .snapspace file (snapspace/model_file); `name` is shown where the file has none. */
export function readFile(container: Container, name: string): Model {
  const kind = container.header["kind"] ?? "posing"; // the first files had only one
  if (POSING.includes(kind)) return readPosing(container, name);
  if (BLENDING.includes(kind)) return readInterpolation(container, name);
  throw new UnreadableModel(
    `This page cannot read models of kind '${kind}'. Open it with the version of Snapspace that wrote it.`,
  );
}

function readPosing(container: Container, name: string): Model {
  const about = JSON.parse(container.header["problem"]);
  const [dimension] = container.shape("basis", 2);
  const [vertices] = container.shape("vertices", 2);
  const rest = container.doubles("vertices", vertices, 3);
  const body = fileBody(container, [rest], about.material);
  const { masses, material } = body;
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

  const K = container.doubles("handle_K", dimension, dimension);
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
      body,
      { basis, tau: rest, rests: [rest] },
      pinsOf({ handleOf, handles, rest, masses, stiffness: Number(about.stiffness) }),
    ),
    handles,
    handleOfVertex:
      paintedOwners(record, names, nearest.length) ?? Int32Array.from(nearest, (vertex) => handleOf[vertex]),
    boxes: boxesOf(about.domain, count),
    mirror: NO_MIRROR,
    elastic: fileElastic(container, body, basis),
    K: body.rigid ? withRemainder(container, K, dimension) : K,
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
  const [samples] = container.shape("training_parameters", 2);
  const mean = container.doubles("mean_shape", 3 * vertices);
  const all = container.doubles("poses", poses.length, vertices, 3);
  const shapes = poses.map((_, k) => all.subarray(3 * vertices * k, 3 * vertices * (k + 1)));
  const body = fileBody(container, shapes, about.material);
  const { faces, embedded } = ownSurface(container, vertices);

  const mass = body.massAt(mean);
  const registeredPoses = shapes.map((shape) => registered(shape, mean, mass));
  const offsets = new Float64Array(all.length); // from the mean shape to the registered poses
  registeredPoses.forEach((pose, k) =>
    offsets.set(
      pose.map((x, i) => x - mean[i]),
      pose.length * k,
    ),
  );

  const basis = container.doubles("basis", dimension, 3 * vertices);
  const base = embedded(mean);
  return {
    kind: "interpolation",
    name,
    ...upOf(readRecord(container), about.surface_source?.name),
    ...timelineOf(readRecord(container)),
    dimension,
    faces,
    appearance: readAppearance(container, about.appearance, base.length / 3),
    space: quantised(base, embedded(basis)),
    ...body.scales,
    material: body.material.kind,
    estimator: estimatorOf(container, body, { basis, tau: mean, rests: registeredPoses }, () => NO_PINS),
    poses,
    poseSpace: quantised(base, embedded(offsets)),
    lowestWeight: -about.extrapolation / poses.length,
    blends: fileBlends(container, body, basis, mean, registeredPoses),
    sampleWeights: container.doubles("training_parameters", samples, poses.length),
    sampleCoordinates: container.doubles("training_coordinates", samples, dimension),
  };
}

function centroid(members: Int32Array, rest: Float64Array, masses: Float64Array): [number, number, number] {
  const sum = [0, 0, 0, 0];
  for (const vertex of members) {
    for (let axis = 0; axis < 3; axis++) sum[axis] += masses[vertex] * rest[3 * vertex + axis];
    sum[3] += masses[vertex];
  }
  return [sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]];
}
