import type { Material } from "./model.ts";

/** Strain energy that a surface shows by itself.
 *
 * Where no force acts on a surface, the stress through it vanishes (plane stress): the strain across follows
 * from the Green strain E (2 x 2) of its triangles, E33 = -lam / (lam + 2 mu) tr E, and the energy density of
 * St.Venant-Kirchhoff material is mu |E|^2 + mu lam / (lam + 2 mu) (tr E)^2. All densities here are per volume
 * at rest, over mu. On handles forces do act, and there it is only near the truth. */
export interface Membrane {
  /** Shapes at rest, x0 y0 z0 x1 ...; the energies relative to them are summed with weights. */
  readonly rests: readonly Float32Array[];
  /** lam / (lam + 2 mu). */
  readonly ratio: number;
}

export function planeStressRatio({ lam, mu }: Material): number {
  return lam / (lam + 2 * mu);
}

/** Of a triangle, from the offsets of its corners: adds weight * area * density and weight * area to sums[at]. */
function addTriangle(
  sums: Float64Array,
  at: number,
  weight: number,
  rest: ArrayLike<number>,
  shape: ArrayLike<number>,
  a: number,
  b: number,
  c: number,
  ratio: number,
): void {
  // plain numbers only: this runs for all triangles of a frame where the graphics cannot do it
  const ux = rest[b] - rest[a];
  const uy = rest[b + 1] - rest[a + 1];
  const uz = rest[b + 2] - rest[a + 2];
  const vx = rest[c] - rest[a];
  const vy = rest[c + 1] - rest[a + 1];
  const vz = rest[c + 2] - rest[a + 2];
  const px = shape[b] - shape[a];
  const py = shape[b + 1] - shape[a + 1];
  const pz = shape[b + 2] - shape[a + 2];
  const qx = shape[c] - shape[a];
  const qy = shape[c + 1] - shape[a + 1];
  const qz = shape[c + 2] - shape[a + 2];
  const uu = ux * ux + uy * uy + uz * uz;
  const uv = ux * vx + uy * vy + uz * vz;
  const vv = vx * vx + vy * vy + vz * vz;
  const determinant = uu * vv - uv * uv;
  if (!(determinant > 1e-12 * uu * vv)) return; // a triangle without area has no strain
  // changes of the metric as products of differences and sums: small strains keep their digits
  const duu = (px - ux) * (px + ux) + (py - uy) * (py + uy) + (pz - uz) * (pz + uz);
  const dvv = (qx - vx) * (qx + vx) + (qy - vy) * (qy + vy) + (qz - vz) * (qz + vz);
  const duv =
    (px - ux) * qx + ux * (qx - vx) + (py - uy) * qy + uy * (qy - vy) + (pz - uz) * qz + uz * (qz - vz);
  const half = 0.5 / determinant;
  const m11 = half * (vv * duu - uv * duv);
  const m12 = half * (vv * duv - uv * dvv);
  const m21 = half * (uu * duv - uv * duu);
  const m22 = half * (uu * dvv - uv * duv);
  const trace = m11 + m22;
  const area = 0.5 * weight * Math.sqrt(determinant);
  sums[at] += area * (m11 * m11 + m22 * m22 + 2 * m12 * m21 + ratio * trace * trace);
  sums[at + 1] += area;
}

/** Density over mu at every vertex: the mean of the triangles around by their areas at rest. */
export function vertexDensities(
  membrane: Membrane,
  weights: ArrayLike<number>,
  shape: ArrayLike<number>,
  faces: Uint32Array,
): Float32Array {
  const vertices = shape.length / 3;
  const sums = new Float64Array(2 * vertices);
  const own = new Float64Array(2);
  for (let f = 0; f < faces.length; f += 3) {
    own.fill(0);
    const [a, b, c] = [faces[f], faces[f + 1], faces[f + 2]];
    membrane.rests.forEach((rest, k) =>
      addTriangle(own, 0, weights[k], rest, shape, 3 * a, 3 * b, 3 * c, membrane.ratio),
    );
    for (const corner of [a, b, c]) {
      sums[2 * corner] += own[0];
      sums[2 * corner + 1] += own[1];
    }
  }
  return Float32Array.from({ length: vertices }, (_, v) =>
    sums[2 * v + 1] > 0 ? sums[2 * v] / sums[2 * v + 1] : 0,
  );
}

/** Density over mu of every triangle. */
export function triangleDensities(
  membrane: Membrane,
  weights: ArrayLike<number>,
  shape: ArrayLike<number>,
  faces: Uint32Array,
): Float64Array {
  const own = new Float64Array(2);
  return Float64Array.from({ length: faces.length / 3 }, (_, triangle) => {
    own.fill(0);
    const [a, b, c] = [0, 1, 2].map((corner) => 3 * faces[3 * triangle + corner]);
    membrane.rests.forEach((rest, k) =>
      addTriangle(own, 0, weights[k], rest, shape, a, b, c, membrane.ratio),
    );
    return own[1] > 0 ? own[0] / own[1] : 0;
  });
}
