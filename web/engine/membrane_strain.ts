/** Shapes at rest of a surface, x0 y0 z0 x1 ...: one, or those of all poses. */
export type Rests = readonly Float32Array[];

/** Strain of a surface from its shape alone, without its material.
 *
 * The Green strain E (2 x 2) of a triangle from its shape at rest, without unit, as its norm |E| = sqrt(E : E):
 * 0.1 for a stretch by about 10 %. Relative to several shapes at rest it is the root of the mean square by their
 * weights and areas, and so it is at a vertex over the triangles around it. */

/** Adds weight * area * |E|^2 and weight * area of a triangle to sums[at], from the offsets of its corners. */
function addTriangle(
  sums: Float64Array,
  weight: number,
  rest: ArrayLike<number>,
  shape: ArrayLike<number>,
  a: number,
  b: number,
  c: number,
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
  const area = 0.5 * weight * Math.sqrt(determinant);
  sums[0] += area * (m11 * m11 + m22 * m22 + 2 * m12 * m21);
  sums[1] += area;
}

/** Strain at every vertex. */
export function vertexStrains(
  rests: Rests,
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
    rests.forEach((rest, k) => addTriangle(own, weights[k], rest, shape, 3 * a, 3 * b, 3 * c));
    for (const corner of [a, b, c]) {
      sums[2 * corner] += own[0];
      sums[2 * corner + 1] += own[1];
    }
  }
  return Float32Array.from({ length: vertices }, (_, v) => rootOfMean(sums[2 * v], sums[2 * v + 1]));
}

/** Strain of every triangle. */
export function triangleStrains(
  rests: Rests,
  weights: ArrayLike<number>,
  shape: ArrayLike<number>,
  faces: Uint32Array,
): Float64Array {
  const own = new Float64Array(2);
  return Float64Array.from({ length: faces.length / 3 }, (_, triangle) => {
    own.fill(0);
    const [a, b, c] = [0, 1, 2].map((corner) => 3 * faces[3 * triangle + corner]);
    rests.forEach((rest, k) => addTriangle(own, weights[k], rest, shape, a, b, c));
    return rootOfMean(own[0], own[1]);
  });
}

/** Beyond the poses weights are negative, and so may be the sum. */
const rootOfMean = (sum: number, area: number) => (area > 0 ? Math.sqrt(Math.max(sum / area, 0)) : 0);
