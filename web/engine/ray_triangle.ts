/** The distance along a ray to the triangle `faces[f..f+2]`, in lengths of the direction; Infinity for a miss.
 *
 * Plain numbers only: this runs for many triangles while the mouse moves. (Moeller and Trumbore 1997) */
export function distanceAlong(
  shape: Float32Array,
  faces: Uint32Array,
  f: number,
  ox: number,
  oy: number,
  oz: number,
  dx: number,
  dy: number,
  dz: number,
): number {
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
  if (determinant === 0) return Infinity;
  const tx = ox - ax;
  const ty = oy - ay;
  const tz = oz - az;
  const s = (tx * px + ty * py + tz * pz) / determinant;
  if (s < 0 || s > 1) return Infinity;
  const qx = ty * uz - tz * uy;
  const qy = tz * ux - tx * uz;
  const qz = tx * uy - ty * ux;
  const r = (dx * qx + dy * qy + dz * qz) / determinant;
  if (r < 0 || s + r > 1) return Infinity;
  const along = (vx * qx + vy * qy + vz * qz) / determinant;
  return along > 0 ? along : Infinity;
}
