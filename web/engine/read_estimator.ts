import type { Container } from "./container.ts";
import { armsOf, type Estimator, type Pins } from "./estimator.ts";
import type { Handle } from "./model.ts";
import type { FileBody } from "./read_body.ts";
import { materialOfTets } from "./read_material.ts";

interface Shapes {
  /** Modes, rows of 3 * vertices numbers. */
  readonly basis: Float64Array;
  readonly tau: Float64Array;
  readonly rests: readonly Float64Array[];
}

interface HandleData {
  readonly handleOf: Int32Array;
  readonly handles: readonly Handle[];
  readonly rest: Float64Array;
  readonly masses: Float64Array;
  readonly stiffness: number;
}

/** The estimator of a model file: takes the elements around the sampled vertices out of the mesh; null without one. */
export function estimatorOf(
  container: Container,
  { elements: tets, material, rigid }: FileBody,
  { basis, tau, rests }: Shapes,
  pins: (corners: number[], isSampled: boolean[]) => Pins,
): Estimator | null {
  if (!container.has("estimator_vertices")) return null;
  const [count] = container.shape("estimator_vertices", 1);
  const [frames, dimension] = container.shape("estimator_coordinates", 2);
  const vertices = container.indices("estimator_vertices", tau.length / 3, [count]);
  const sampled = new Set(vertices);
  // the rotations of neighbours count too where a surface is as rigid as possible
  const chosen = elementsAt(tets, rigid ? new Set(cornersOf(tets, elementsAt(tets, sampled))) : sampled);
  const around = cornersOf(tets, chosen);
  const corners = [...new Set(around)].sort((a, b) => a - b);
  const place = new Map(corners.map((vertex, i) => [vertex, i]));
  const taken = (rows: Float64Array, row = 0) =>
    Float64Array.from({ length: 3 * corners.length }, (_, i) => {
      const vertex = corners[Math.floor(i / 3)];
      return rows[row * tau.length + 3 * vertex + (i % 3)];
    });
  const modes = new Float32Array(3 * corners.length * dimension);
  for (let mode = 0; mode < dimension; mode++) modes.set(taken(basis, mode), 3 * corners.length * mode);
  return {
    mass: container.doubles("estimator_mass", 1)[0],
    modes,
    base: taken(tau),
    rests: rests.map((rest) => taken(rest)),
    tets: around.map((vertex) => place.get(vertex)!),
    material: materialOfTets(material, chosen),
    places: vertices.map((vertex) => place.get(vertex)!),
    weights: container.doubles("estimator_weights", count),
    pins: pins(
      corners,
      corners.map((vertex) => sampled.has(vertex)),
    ),
    coordinates: container.doubles("estimator_coordinates", frames, dimension),
    ratios: container.doubles("estimator_residual_ratios", frames),
    exponent: exponentOf(container),
  };
}

/** The elements with a corner in a set. */
function elementsAt(elements: Int32Array, vertices: Set<number>): Int32Array {
  const all = Int32Array.from({ length: elements.length / 4 }, (_, element) => element);
  return all.filter((element) =>
    elements.subarray(4 * element, 4 * element + 4).some((vertex) => vertices.has(vertex)),
  );
}

function cornersOf(elements: Int32Array, chosen: Int32Array): Int32Array<ArrayBuffer> {
  return Int32Array.from({ length: 4 * chosen.length }, (_, i) => elements[4 * chosen[i >> 2] + (i & 3)]);
}

/** The exponent of residuals; files of earlier calibrations have none, and it is 1. */
export function exponentOf(container: Container): number {
  return container.has("estimator_exponent") ? container.doubles("estimator_exponent", 1)[0] : 1;
}

/** The sampled vertices that handles hold. */
export function pinsOf(corners: number[], isSampled: boolean[], held: HandleData): Pins {
  const { handleOf, handles, rest, masses, stiffness } = held;
  const pinned = corners.flatMap((vertex, i) => (isSampled[i] && handleOf[vertex] >= 0 ? [i] : []));
  const owners = Int32Array.from(pinned, (i) => handleOf[corners[i]]);
  const own = Float64Array.from({ length: 3 * corners.length }, (_, i) => {
    const vertex = corners[Math.floor(i / 3)];
    return rest[3 * vertex + (i % 3)];
  });
  return {
    corners: Int32Array.from(pinned),
    handles: owners,
    pulls: Float64Array.from(pinned, (i) => 2 * stiffness * masses[corners[i]]),
    arms: armsOf(Int32Array.from(pinned), owners, handles, own),
  };
}
