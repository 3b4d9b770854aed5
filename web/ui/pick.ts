import type { Ray } from "three";
import { Vector3 } from "three";

/** Where a ray hits a surface. */
export interface Hit {
  point: Vector3;
  /** The corner of the triangle that is closest to the point. */
  vertex: number;
  /** The corners. */
  corners: [number, number, number];
}

/** The first hit of a ray, in the frame of the shape; null beside it. (Moeller and Trumbore 1997) */
export function pick(ray: Ray, shape: Float32Array, faces: Uint32Array): Hit | null {
  const [ox, oy, oz] = ray.origin.toArray();
  const [dx, dy, dz] = ray.direction.toArray();
  let [nearest, face] = [Infinity, -1];
  for (let f = 0; f < faces.length; f += 3) {
    const [a, b, c] = [3 * faces[f], 3 * faces[f + 1], 3 * faces[f + 2]];
    const [ux, uy, uz] = [shape[b] - shape[a], shape[b + 1] - shape[a + 1], shape[b + 2] - shape[a + 2]];
    const [vx, vy, vz] = [shape[c] - shape[a], shape[c + 1] - shape[a + 1], shape[c + 2] - shape[a + 2]];
    const [px, py, pz] = [dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx];
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const [tx, ty, tz] = [ox - shape[a], oy - shape[a + 1], oz - shape[a + 2]];
    const s = (tx * px + ty * py + tz * pz) / determinant;
    if (s < 0 || s > 1) continue;
    const [qx, qy, qz] = [ty * uz - tz * uy, tz * ux - tx * uz, tx * uy - ty * ux];
    const r = (dx * qx + dy * qy + dz * qz) / determinant;
    const along = (vx * qx + vy * qy + vz * qz) / determinant;
    if (r < 0 || s + r > 1 || along <= 0 || along >= nearest) continue;
    [nearest, face] = [along, f];
  }
  if (face < 0) return null;
  const point = ray.at(nearest, new Vector3());
  const corners: [number, number, number] = [faces[face], faces[face + 1], faces[face + 2]];
  const away = (vertex: number) => new Vector3().fromArray(shape, 3 * vertex).distanceTo(point);
  return { point, corners, vertex: corners.reduce((best, v) => (away(v) < away(best) ? v : best)) };
}
