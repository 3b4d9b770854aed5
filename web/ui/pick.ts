import type { Ray } from "three";
import { Vector3 } from "three";

import { distanceAlong } from "../engine/ray_triangle.ts";

/** Where a ray hits a surface. */
export interface Hit {
  point: Vector3;
  /** The corner of the triangle that is closest to the point. */
  vertex: number;
  /** The corners. */
  corners: [number, number, number];
}

/** The first hit of a ray, in the frame of the shape; null beside it. Looks at all triangles. */
export function pick(ray: Ray, shape: Float32Array, faces: Uint32Array): Hit | null {
  const { x: ox, y: oy, z: oz } = ray.origin;
  const { x: dx, y: dy, z: dz } = ray.direction;
  let nearest = Infinity;
  let face = -1;
  for (let f = 0; f < faces.length; f += 3) {
    const along = distanceAlong(shape, faces, f, ox, oy, oz, dx, dy, dz);
    if (along < nearest) [nearest, face] = [along, f];
  }
  if (face < 0) return null;
  const point = ray.at(nearest, new Vector3());
  const corners: [number, number, number] = [faces[face], faces[face + 1], faces[face + 2]];
  const away = (vertex: number) => new Vector3().fromArray(shape, 3 * vertex).distanceTo(point);
  return { point, corners, vertex: corners.reduce((best, v) => (away(v) < away(best) ? v : best)) };
}
