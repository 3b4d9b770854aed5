import type { Container } from "./container.ts";
import type { BlendedStars, Cubature } from "./model.ts";
import { readLocalRows } from "./read_local_rows.ts";
import { oneRings, STAR_MODULI, VertexStars, type RigidSurface, type StarTriangles } from "./vertex_stars.ts";

/** The density of stars. */
export const KIND = "shell-arap";

/** The cubature of an as-rigid-as-possible surface. For what its stars leave of the energy, see `withRemainder`. */
export function starCubature(
  container: Container,
  rest: Float64Array,
  surface: RigidSurface,
  basis: Float64Array,
): Cubature {
  const chosen = chosenStars(container, surface, rest.length / 3);
  const stars = new VertexStars(rest, surface, chosen);
  const dimension = basis.length / rest.length;
  const local = readLocalRows(container, chosen.length, dimension);
  return {
    kind: "cubature",
    ...(local ?? { rows: rowsOf([stars], basis, dimension), clusters: null }),
    weights: container.doubles("cubature_weights", chosen.length),
    material: { kind: KIND, rows: chosen.length, moduli: stars.moduli },
  };
}

/** K of the handles, with what the stars of a posing model leave of the elastic energy. */
export function withRemainder(container: Container, K: Float64Array<ArrayBuffer>, dimension: number) {
  const remainder = container.doubles("stars_remainder", dimension, dimension);
  return K.map((x, i) => x + remainder[i]);
}

/** The blended energy of an as-rigid-as-possible surface; `poses` are registered to the mean shape. */
export function blendedStars(
  container: Container,
  poses: readonly Float64Array[],
  surface: RigidSurface,
  basis: Float64Array,
  mean: Float64Array,
): BlendedStars {
  const dimension = basis.length / mean.length;
  const chosen = chosenStars(container, surface, mean.length / 3);
  const stars = poses.map((pose) => new VertexStars(pose, surface, chosen));
  const moduli = new Float64Array(STAR_MODULI * chosen.length * poses.length);
  const origins = new Float64Array(9 * chosen.length * poses.length);
  stars.forEach((ofPose, k) => {
    const perFirstArea = ofPose.moduli.slice();
    chosen.forEach((_, i) => (perFirstArea[STAR_MODULI * i] *= ofPose.areas[i] / stars[0].areas[i]));
    moduli.set(perFirstArea, k * perFirstArea.length);
    const displaced = mean.map((x, i) => x - poses[k][i]);
    origins.set(ofPose.numbers(displaced), 9 * chosen.length * k);
  });
  return {
    kind: "stars",
    rows: rowsOf(stars, basis, dimension),
    weights: container.doubles("cubature_weights", chosen.length),
    material: { kind: KIND, rows: moduli.length / STAR_MODULI, moduli },
    origins,
    forms: container.doubles("stars_forms", poses.length, dimension + 1, dimension + 1),
    dirichlet: container.doubles("stars_dirichlet", poses.length, dimension, dimension),
  };
}

/** The nine numbers of the modes, poses x stars x 9 x dimension. */
function rowsOf(poses: readonly VertexStars[], basis: Float64Array, dimension: number) {
  const size = 9 * poses[0].areas.length;
  const rows = new Float32Array(poses.length * size * dimension);
  for (let mode = 0; mode < dimension; mode++) {
    const shape = basis.subarray((mode * basis.length) / dimension, ((mode + 1) * basis.length) / dimension);
    poses.forEach((stars, k) =>
      stars.numbers(shape).forEach((x, i) => (rows[(k * size + i) * dimension + mode] = x)),
    );
  }
  return rows;
}

/** The triangles of the chosen stars: as in the file, or else one ring of each vertex. */
function chosenStars(container: Container, { triangles }: RigidSurface, vertices: number): StarTriangles[] {
  const chosen = container.indices("cubature_tets", vertices, container.shape("cubature_tets", 1));
  if (!container.has("stars_starts")) return oneRings(triangles, chosen, vertices);
  return starsIn(container, "stars", triangles, chosen.length);
}

/** The triangles of stars in a file: arrays whose names begin alike. */
export function starsIn(
  container: Container,
  name: string,
  triangles: Int32Array,
  stars = container.shape(`${name}_starts`, 1)[0] - 1,
): StarTriangles[] {
  const [count] = container.shape(`${name}_triangles`, 1);
  const starts = container.indices(`${name}_starts`, count + 1, [stars + 1]);
  const own = container.indices(`${name}_triangles`, triangles.length / 3, [count]);
  const shares = container.doubles(`${name}_shares`, count);
  return Array.from({ length: stars }, (_, i) => ({
    triangles: own.subarray(starts[i], starts[i + 1]),
    shares: shares.subarray(starts[i], starts[i + 1]),
  }));
}
