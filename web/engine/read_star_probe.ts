import type { Container } from "./container.ts";
import { DirichletForces } from "./dirichlet_forces.ts";
import type { StarProbe } from "./estimator.ts";
import type { ProbeSample, Shapes } from "./read_estimator.ts";
import { KIND, starsIn } from "./read_stars.ts";
import { oneRings, STAR_MODULI, VertexStars, type RigidSurface, type StarTriangles } from "./vertex_stars.ts";

/** A probe of the stars around the sampled vertices, whose rotations turn the forces there; as StarProbe of the Python
 * package. */
export function starProbe(
  container: Container,
  surface: RigidSurface,
  { basis, tau, rests }: Shapes,
  sample: ProbeSample,
): StarProbe {
  const vertices = Int32Array.from(new Set(sample.vertices)).sort(); // one may be drawn twice
  const weights = new Float64Array(vertices.length);
  sample.vertices.forEach((vertex, i) => (weights[vertices.indexOf(vertex)] += sample.weights[i]));
  const chosen = starsAround(container, surface, vertices, tau.length / 3);
  const pins = sample.pins(vertices, () => true);
  const poses = rests.map((rest) => {
    const stars = new VertexStars(rest, surface, chosen);
    return { stars, parts: stars.parts(vertices), forces: new DirichletForces(rest, surface, vertices) };
  });
  const [{ parts }] = poses;

  /** The numbers of a displacement from a pose: nine per star, and then the linear functions. */
  const numbersIn = ({ stars, parts, forces }: (typeof poses)[number], displacement: Float64Array) => {
    const nine = stars.numbers(displacement);
    const linear = forces.at(displacement);
    // what a star's best affine map has of the Dirichlet energy is not in the quadratic form
    for (let p = 0; p < parts.stars.length; p++) {
      const [a, b, c] = [parts.vectors[3 * p], parts.vectors[3 * p + 1], parts.vectors[3 * p + 2]];
      for (let row = 0; row < 3; row++) {
        const at = 9 * parts.stars[p] + 3 * row;
        linear[3 * parts.places[p] + row] -= 2 * (nine[at] * a + nine[at + 1] * b + nine[at + 2] * c);
      }
    }
    pins.corners.forEach((place, i) => {
      for (let axis = 0; axis < 3; axis++)
        linear[3 * place + axis] += pins.pulls[i] * displacement[3 * vertices[place] + axis];
    });
    const all = new Float64Array(nine.length + linear.length);
    all.set(nine);
    all.set(linear, nine.length);
    return all;
  };

  const size = 9 * chosen.length + 3 * vertices.length;
  const dimension = basis.length / tau.length;
  const origins = new Float64Array(poses.length * size);
  const modes = new Float32Array(poses.length * dimension * size);
  const moduli = new Float64Array(poses.length * STAR_MODULI * chosen.length);
  poses.forEach((pose, k) => {
    origins.set(
      numbersIn(
        pose,
        tau.map((x, i) => x - rests[k][i]),
      ),
      k * size,
    );
    for (let mode = 0; mode < dimension; mode++) {
      const shape = basis.subarray(mode * tau.length, (mode + 1) * tau.length);
      modes.set(numbersIn(pose, shape), (k * dimension + mode) * size);
    }
    const own = pose.stars.moduli.map((x, i) => (i % STAR_MODULI === 0 ? 1 : x)); // parts have the moduli
    moduli.set(own, k * own.length);
  });
  return {
    kind: "stars",
    origins,
    modes,
    material: { kind: KIND, rows: poses.length * chosen.length, moduli },
    partStars: parts.stars,
    partPlaces: parts.places,
    partVectors: Float64Array.from(poses.flatMap((pose) => [...pose.parts.vectors])),
    weights,
    pins,
  };
}

/** The stars around some vertices: as in the file, or else one ring of each vertex of the triangles there. */
function starsAround(
  container: Container,
  { triangles }: RigidSurface,
  vertices: Int32Array,
  count: number,
): StarTriangles[] {
  if (container.has("estimator_stars_starts")) return starsIn(container, "estimator_stars", triangles);
  const near = new Set<number>();
  for (const ring of oneRings(triangles, vertices, count))
    for (const triangle of Array.from(ring.triangles))
      for (let corner = 0; corner < 3; corner++) near.add(triangles[3 * triangle + corner]);
  return oneRings(triangles, Int32Array.from(near).sort(), count);
}
