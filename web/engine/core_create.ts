import {
  BASIS,
  CUBATURE,
  ERROR,
  MATERIAL,
  PROBE,
  STAR_PROBE,
  STARS,
  type CoreExports,
} from "./core_exports.ts";
import { CoreMemory } from "./core_memory.ts";
import { UnreadableModel } from "./errors.ts";
import type { ElementProbe, Estimator, StarProbe } from "./estimator.ts";
import type { BlendedStars, BlendingModel, Body, Cubature, Material, PosingModel } from "./model.ts";

/** A session of the core, as a pointer. Throws UnreadableModel for a damaged model, or one of an unknown material. */
export function createSession(exports: CoreExports, model: PosingModel | BlendingModel): number {
  const memory = new CoreMemory(exports);
  if (exports.snapspace_moduli(memory.text(model.material)) < 0) throw unknownMaterial(model.material);
  const basis = memory.struct(BASIS, { vertices: 0, tau: 0, modes: 0 }); // coordinates only
  const error = memory.numbers(new Int32Array(1));
  const session =
    model.kind === "posing"
      ? createPosing(exports, memory, model, basis, error)
      : createBlending(exports, memory, model, basis, error);
  const code = new Int32Array(exports.memory.buffer, error, 1)[0];
  if (session === 0)
    throw new UnreadableModel(
      code === ERROR.NOT_DEFINITE
        ? "The model is damaged: its energy has no minimum at rest. Build it again."
        : `The model does not fit the page's core (error ${code}).`,
    );
  if (model.estimator) setProbe(exports, memory, session, model.estimator);
  memory.free();
  return session;
}

function createPosing(
  exports: CoreExports,
  memory: CoreMemory,
  { dimension, handles, elastic, ...model }: PosingModel,
  basis: number,
  error: number,
): number {
  const [K, L, S] = [model.K, model.L, model.S].map((array) => memory.numbers(array));
  if (elastic.kind === "quartic") {
    const quartic = memory.numbers(elastic.coefficients);
    return exports.snapspace_create_posing(dimension, handles.length, quartic, K, L, S, basis, error);
  }
  const cubature = cubatureOf(exports, memory, elastic, dimension);
  return exports.snapspace_create_posing_cubature(dimension, handles.length, cubature, K, L, S, basis, error);
}

function createBlending(
  exports: CoreExports,
  memory: CoreMemory,
  { dimension, poses, blends }: BlendingModel,
  basis: number,
  error: number,
): number {
  if (blends.kind === "quartics") {
    const quartics = new CoreMemory(exports).numbers(blends.coefficients); // read in place: stays
    return exports.snapspace_create_blending(dimension, poses.length, quartics, basis, error);
  }
  if (blends.kind === "stars") {
    const stars = starsOf(exports, memory, blends, poses.length);
    return exports.snapspace_create_blending_stars(dimension, stars, basis, error);
  }
  const cubature = cubatureOf(exports, memory, blends, dimension);
  const ofTau = 12 * blends.weights.length * poses.length;
  const [corners, tau] = [blends.corners.subarray(0, ofTau), blends.corners.subarray(ofTau)].map((array) =>
    memory.numbers(array),
  );
  return exports.snapspace_create_blending_cubature(
    dimension,
    poses.length,
    cubature,
    corners,
    tau,
    basis,
    error,
  );
}

function starsOf(exports: CoreExports, memory: CoreMemory, blends: BlendedStars, poses: number): number {
  return memory.struct(STARS, {
    poses,
    stars: blends.weights.length,
    rows: memory.numbers(blends.rows),
    weights: memory.numbers(blends.weights),
    ...materialOf(exports, memory, blends.material),
    origins: memory.numbers(blends.origins),
    forms: memory.numbers(blends.forms),
  });
}

function cubatureOf(exports: CoreExports, memory: CoreMemory, elastic: Cubature, dimension: number): number {
  return memory.struct(CUBATURE, {
    tets: elastic.weights.length,
    rows: rowsOf(exports, memory, elastic, dimension),
    weights: memory.numbers(elastic.weights),
    ...materialOf(exports, memory, elastic.material),
    clustersCount: elastic.clusters ? elastic.clusters.sizes.length / 2 : 0,
    clustersSizes: elastic.clusters ? memory.numbers(elastic.clusters.sizes) : 0,
    clustersModes: elastic.clusters ? memory.numbers(elastic.clusters.modes) : 0,
  });
}

function rowsOf(exports: CoreExports, memory: CoreMemory, elastic: Cubature, dimension: number): number {
  const { rows, material } = elastic;
  if (rows instanceof Float32Array) return memory.numbers(rows);
  const tets = rows.points.length / 12;
  const made = memory.take(4 * 9 * tets * dimension);
  const [points, modes] = [memory.numbers(rows.points), memory.numbers(rows.modes)];
  const shell = material.shell ? memory.numbers(material.moduli as Float64Array) : 0;
  exports.snapspace_displacement_rows(tets, dimension, points, modes, shell, made);
  return made;
}

function setProbe(exports: CoreExports, memory: CoreMemory, session: number, { probe }: Estimator): void {
  const pins = {
    pins: probe.pins.corners.length,
    pinned: memory.numbers(probe.pins.corners),
    pinHandles: memory.numbers(probe.pins.handles),
    pulls: memory.numbers(probe.pins.pulls),
    arms: memory.numbers(probe.pins.arms),
  };
  const given = {
    ...pins,
    ...materialOf(exports, memory, probe.material),
    weights: memory.numbers(probe.weights),
  };
  const code =
    probe.kind === "stars"
      ? exports.snapspace_set_star_probe(session, memory.struct(STAR_PROBE, starFields(memory, probe, given)))
      : exports.snapspace_set_probe(session, memory.struct(PROBE, elementFields(memory, probe, given)));
  if (code !== ERROR.OK)
    throw new UnreadableModel(`The error estimates of the model do not fit (error ${code}). Build it again.`);
}

type Fields = Readonly<Record<string, number>>;

function elementFields(memory: CoreMemory, probe: ElementProbe, given: Fields): Fields {
  const { tets, rests, places } = probe;
  const shapes = new Float64Array(rests.length * rests[0].length);
  rests.forEach((rest, k) => shapes.set(rest, k * rest.length));
  return {
    ...given,
    corners: probe.base.length / 3,
    tets: tets.length / 4,
    rests: rests.length,
    samples: places.length,
    tau: memory.numbers(probe.base),
    modes: memory.numbers(Float64Array.from(probe.modes)),
    restShapes: memory.numbers(shapes),
    tetCorners: memory.numbers(tets),
    sampled: memory.numbers(places),
  };
}

function starFields(memory: CoreMemory, probe: StarProbe, given: Fields): Fields {
  const poses = probe.partVectors.length / (3 * probe.partStars.length);
  return {
    ...given,
    stars: probe.material.rows / poses,
    rests: poses,
    samples: probe.weights.length,
    parts: probe.partStars.length,
    origins: memory.numbers(probe.origins),
    modes: memory.numbers(probe.modes),
    partStars: memory.numbers(probe.partStars),
    partSamples: memory.numbers(probe.partPlaces),
    partVectors: memory.numbers(probe.partVectors),
  };
}

/** The unit of energy, if it must be computed. */
export function valueScaleOf(exports: CoreExports, given: number | Body): number {
  if (typeof given === "number") return given;
  const memory = new CoreMemory(exports);
  const {
    materialKind: kind,
    materialCount: count,
    materialModuli: moduli,
  } = materialOf(exports, memory, given.material);
  const material = memory.struct(MATERIAL, { kind, count, moduli });
  const scale = memory.take(8);
  const volumes = memory.numbers(given.volumes);
  const code = exports.snapspace_value_scale(material, given.volumes.length, volumes, scale);
  if (code !== ERROR.OK)
    throw new UnreadableModel(`The model's moduli do not fit (error ${code}). Build it again.`);
  const [value] = memory.doubles(scale, 1);
  memory.free();
  return value;
}

/** The fields of a snapspace_material. */
function materialOf(exports: CoreExports, memory: CoreMemory, material: Material) {
  const { kind, rows, moduli, shell } = material;
  const name = memory.text(kind);
  const count = exports.snapspace_moduli(name);
  if (shell) {
    const made = memory.take(8 * Math.max(count, 0) * rows);
    const given = memory.numbers(moduli as Float64Array);
    const [points, products] = [memory.numbers(shell.points), memory.numbers(shell.products)];
    if (exports.snapspace_shell_moduli(name, rows, points, given, products, made) !== ERROR.OK)
      throw unknownMaterial(kind);
    return { materialKind: name, materialCount: rows, materialModuli: made };
  }
  const numbers =
    moduli instanceof Float64Array
      ? moduli
      : Float64Array.from({ length: count }, (_, i) => {
          const modulus = memory.readText(exports.snapspace_modulus_name(name, i));
          return Number(moduli[modulus] ?? NaN);
        });
  if (numbers.length !== rows * count || numbers.some(Number.isNaN))
    throw new UnreadableModel(`The model has no moduli that fit '${kind}'. Build it again.`);
  return { materialKind: name, materialCount: rows, materialModuli: memory.numbers(numbers) };
}

function unknownMaterial(kind: string): UnreadableModel {
  return new UnreadableModel(
    `The model is of material '${kind}', which this page does not know. Open it with the version of Snapspace that wrote it.`,
  );
}
