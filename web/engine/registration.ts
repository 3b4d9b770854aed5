/** Rigid registration in the M-norm, M the consistent mass matrix of linear tets or triangles (Horn 1987, Closed-form
 * solution of absolute orientation using unit quaternions). */

import type { Mass } from "./mass.ts";
import { applied, minus, type RigidMap, type Vector } from "./motion.ts";
import { symmetricEigen } from "./symmetric_eigen.ts";

type Rows = Float64Array; // x0 y0 z0 x1 ...

/** The shape after the proper rigid motion that brings it closest to `onto`. */
export function registered(shape: Rows, onto: Rows, mass: Mass): Rows {
  const massOnto = massTimes(onto, mass);
  const total = mass.volumes.reduce((sum, volume) => sum + Math.abs(volume), 0);
  const from = centroid(massTimes(shape, mass), total);
  const to = centroid(massOnto, total);
  const covariance = new Float64Array(9); // sum over rows of shape_a (M onto)_b, about the centroids
  for (let i = 0; i < shape.length; i += 3)
    for (let a = 0; a < 3; a++)
      for (let b = 0; b < 3; b++) covariance[3 * a + b] += shape[i + a] * massOnto[i + b];
  for (let a = 0; a < 3; a++) for (let b = 0; b < 3; b++) covariance[3 * a + b] -= total * from[a] * to[b];
  const R = bestRotation(covariance);
  const moved = new Float64Array(shape.length);
  for (let i = 0; i < shape.length; i += 3)
    for (let a = 0; a < 3; a++)
      moved[i + a] =
        R[3 * a] * (shape[i] - from[0]) +
        R[3 * a + 1] * (shape[i + 1] - from[1]) +
        R[3 * a + 2] * (shape[i + 2] - from[2]) +
        to[a];
  return moved;
}

/** The rigid map that brings points closest to others, by the sum of squared distances; the identity without points. */
export function closestMap(from: readonly Vector[], to: readonly Vector[]): RigidMap {
  const [middle, goal] = [mean(from), mean(to)];
  const covariance = new Float64Array(9);
  from.forEach((point, k) => {
    const [x, y] = [minus(point, middle), minus(to[k], goal)];
    for (let a = 0; a < 3; a++) for (let b = 0; b < 3; b++) covariance[3 * a + b] += x[a] * y[b];
  });
  const rotation = bestRotation(covariance);
  return { rotation, shift: minus(goal, applied(rotation, middle)) };
}

function mean(points: readonly Vector[]): Vector {
  const at = (axis: number) => points.reduce((sum, point) => sum + point[axis], 0) / (points.length || 1);
  return [at(0), at(1), at(2)];
}

function massTimes(shape: Rows, { cells, corners, volumes }: Mass): Rows {
  const product = new Float64Array(shape.length);
  for (let cell = 0; cell < volumes.length; cell++) {
    const share = Math.abs(volumes[cell]) / (corners * (corners + 1));
    for (let axis = 0; axis < 3; axis++) {
      let sum = 0;
      for (let corner = 0; corner < corners; corner++)
        sum += shape[3 * cells[corners * cell + corner] + axis];
      for (let corner = 0; corner < corners; corner++) {
        const i = 3 * cells[corners * cell + corner] + axis;
        product[i] += share * (sum + shape[i]);
      }
    }
  }
  return product;
}

function centroid(massTimesShape: Rows, total: number): number[] {
  const sums = [0, 0, 0];
  for (let i = 0; i < massTimesShape.length; i++) sums[i % 3] += massTimesShape[i];
  return sums.map((sum) => sum / total);
}

/** The rotation (3 x 3) that maximises tr(R C): the quaternion to the largest eigenvalue of Horn's matrix. */
function bestRotation(C: Float64Array): number[] {
  const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = C;
  const N = [
    [xx + yy + zz, yz - zy, zx - xz, xy - yx],
    [yz - zy, xx - yy - zz, xy + yx, zx + xz],
    [zx - xz, xy + yx, yy - xx - zz, yz + zy],
    [xy - yx, zx + xz, yz + zy, zz - xx - yy],
  ];
  const { values, vectors } = symmetricEigen(N);
  const [w, x, y, z] = vectors[values.indexOf(Math.max(...values))];
  return [
    1 - 2 * (y * y + z * z),
    2 * (x * y - w * z),
    2 * (x * z + w * y),
    2 * (x * y + w * z),
    1 - 2 * (x * x + z * z),
    2 * (y * z - w * x),
    2 * (x * z - w * y),
    2 * (y * z + w * x),
    1 - 2 * (x * x + y * y),
  ];
}
