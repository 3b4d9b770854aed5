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
  const { x: ox, y: oy, z: oz } = ray.origin;
  const { x: dx, y: dy, z: dz } = ray.direction;
  let nearest = Infinity;
  let face = -1;
  // plain numbers only: this loop runs while the mouse moves, over all triangles
  for (let f = 0; f < faces.length; f += 3) {
    const a = 3 * faces[f];
    const b = 3 * faces[f + 1];
    const c = 3 * faces[f + 2];
    const ax = shape[a];
    const ay = shape[a + 1];
    const az = shape[a + 2];
    const ux = shape[b] - ax;
    const uy = shape[b + 1] - ay;
    const uz = shape[b + 2] - az;
    const vx = shape[c] - ax;
    const vy = shape[c + 1] - ay;
    const vz = shape[c + 2] - az;
    const px = dy * vz - dz * vy;
    const py = dz * vx - dx * vz;
    const pz = dx * vy - dy * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const tx = ox - ax;
    const ty = oy - ay;
    const tz = oz - az;
    const s = (tx * px + ty * py + tz * pz) / determinant;
    if (s < 0 || s > 1) continue;
    const qx = ty * uz - tz * uy;
    const qy = tz * ux - tx * uz;
    const qz = tx * uy - ty * ux;
    const r = (dx * qx + dy * qy + dz * qz) / determinant;
    const along = (vx * qx + vy * qy + vz * qz) / determinant;
    if (r < 0 || s + r > 1 || along <= 0 || along >= nearest) continue;
    nearest = along;
    face = f;
  }
  if (face < 0) return null;
  const point = ray.at(nearest, new Vector3());
  const corners: [number, number, number] = [faces[face], faces[face + 1], faces[face + 2]];
  const away = (vertex: number) => new Vector3().fromArray(shape, 3 * vertex).distanceTo(point);
  return { point, corners, vertex: corners.reduce((best, v) => (away(v) < away(best) ? v : best)) };
}
