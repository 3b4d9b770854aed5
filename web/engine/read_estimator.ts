import type { Container } from "./container.ts";
import { armsOf, rowsAt, type ElementProbe, type Estimator, type Pins } from "./estimator.ts";
import type { Handle } from "./model.ts";
import type { FileBody } from "./read_body.ts";
import { materialOfTets } from "./read_material.ts";
import { starProbe } from "./read_star_probe.ts";

export interface Shapes {
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

/** Which of the vertices that a probe knows, ascending, are pinned; only sampled ones count. */
export type FindPins = (known: ArrayLike<number>, isSampled: (vertex: number) => boolean) => Pins;

/** The estimator of a model file: takes what the gradient at the sampled vertices depends on out of the mesh; null without one. */
export function estimatorOf(
  container: Container,
  body: FileBody,
  shapes: Shapes,
  pins: FindPins,
): Estimator | null {
  if (!container.has("estimator_vertices")) return null;
  const [count] = container.shape("estimator_vertices", 1);
  const vertices = container.indices("estimator_vertices", shapes.tau.length / 3, [count]);
  const weights = container.doubles("estimator_weights", count);
  const [frames, dimension] = container.shape("estimator_coordinates", 2);
  return {
    mass: container.doubles("estimator_mass", 1)[0],
    probe: body.rigid
      ? starProbe(container, body.rigid, shapes, { vertices, weights, pins })
      : elementProbe(body, shapes, { vertices, weights, pins }),
    coordinates: container.doubles("estimator_coordinates", frames, dimension),
    ratios: container.doubles("estimator_residual_ratios", frames),
    exponent: exponentOf(container),
  };
}

/** The vertices where residuals are read, and the weights of their squares. */
export interface ProbeSample {
  readonly vertices: Int32Array;
  readonly weights: Float64Array;
  readonly pins: FindPins;
}

/** A probe of the elements around the sampled vertices. */
function elementProbe(
  { elements: tets, material }: FileBody,
  { basis, tau, rests }: Shapes,
  { vertices, weights, pins }: ProbeSample,
): ElementProbe {
  const sampled = new Set(vertices);
  const chosen = elementsAt(tets, sampled);
  const around = cornersOf(tets, chosen);
  const corners = [...new Set(around)].sort((a, b) => a - b);
  const place = new Map(corners.map((vertex, i) => [vertex, i]));
  const dimension = basis.length / tau.length;
  const modes = new Float32Array(3 * corners.length * dimension);
  for (let mode = 0; mode < dimension; mode++) {
    const shape = basis.subarray(mode * tau.length, (mode + 1) * tau.length);
    modes.set(rowsAt(shape, corners), 3 * corners.length * mode);
  }
  return {
    kind: "elements",
    modes,
    base: rowsAt(tau, corners),
    rests: rests.map((rest) => rowsAt(rest, corners)),
    tets: around.map((vertex) => place.get(vertex)!),
    material: materialOfTets(material, chosen),
    places: vertices.map((vertex) => place.get(vertex)!),
    weights,
    pins: pins(corners, (vertex) => sampled.has(vertex)),
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
export function pinsOf({ handleOf, handles, rest, masses, stiffness }: HandleData): FindPins {
  return (known, isSampled) => {
    const pinned = Int32Array.from(known, (_, i) => i).filter(
      (i) => isSampled(known[i]) && handleOf[known[i]] >= 0,
    );
    const vertices = pinned.map((i) => known[i]);
    const owners = vertices.map((vertex) => handleOf[vertex]);
    return {
      corners: pinned,
      handles: owners,
      pulls: Float64Array.from(vertices, (vertex) => 2 * stiffness * masses[vertex]),
      arms: armsOf(rowsAt(rest, vertices), owners, handles),
    };
  };
}
