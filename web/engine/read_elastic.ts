import type { Container } from "./container.ts";
import type { FileBody } from "./read_body.ts";
import { readLocalRows } from "./read_local_rows.ts";
import { materialOfTets } from "./read_material.ts";
import { blendedStars, starCubature } from "./read_stars.ts";
import {
  coefficientCount,
  type BlendedCubature,
  type BlendedStars,
  type CornerModes,
  type Cubature,
  type PoseQuartics,
  type Quartic,
} from "./model.ts";

/** The elastic energy of a posing model's file. */
export function fileElastic(container: Container, body: FileBody, basis: Float64Array): Quartic | Cubature {
  if (!container.has("cubature_tets")) {
    const coefficients = coefficientCount(basis.length / body.shapes[0].length);
    return { kind: "quartic", coefficients: container.doubles("quartic", coefficients) };
  }
  return body.rigid
    ? starCubature(container, body.shapes[0], body.rigid, basis)
    : cubatureOf(container, body, basis);
}

/** The energies relative to all poses; `poses` are registered to the mean shape. */
export function fileBlends(
  container: Container,
  body: FileBody,
  basis: Float64Array,
  mean: Float64Array,
  poses: readonly Float64Array[],
): PoseQuartics | BlendedCubature | BlendedStars {
  const { shapes, elements } = body;
  if (!container.has("cubature_tets")) {
    const coefficients = coefficientCount(basis.length / mean.length);
    return { kind: "quartics", coefficients: container.doubles("quartics", shapes.length, coefficients) };
  }
  if (body.rigid) return blendedStars(container, poses, body.rigid, basis, mean);
  const chosen = chosenElements(container, elements.length / 4);
  const corners = new Float64Array(12 * chosen.length * (shapes.length + 1));
  [...shapes, mean].forEach((shape, k) =>
    corners.set(cornersOf(shape, elements, chosen), 12 * chosen.length * k),
  );
  return { ...cubatureOf(container, body, basis), corners };
}

function chosenElements(container: Container, count: number): Int32Array<ArrayBuffer> {
  return container.indices("cubature_tets", count, container.shape("cubature_tets", 1));
}

function cubatureOf(container: Container, body: FileBody, basis: Float64Array): Cubature {
  const { shapes, elements, material } = body;
  const chosen = chosenElements(container, elements.length / 4);
  const dimension = basis.length / shapes[0].length;
  const local = readLocalRows(container, chosen.length, dimension);
  return {
    kind: "cubature",
    ...(local ?? { rows: cornerModes(shapes[0], elements, basis, chosen), clusters: null }),
    weights: container.doubles("cubature_weights", chosen.length),
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
