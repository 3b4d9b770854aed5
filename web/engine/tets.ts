import { UnreadableModel } from "./errors.ts";

/** Volumes and size of a tet mesh at rest. Shapes are x0 y0 z0 x1 ..., tets 4 indices each. */

/** Signed volumes. */
export function tetVolumes(shape: ArrayLike<number>, tets: Int32Array): Float64Array {
  const volumes = new Float64Array(tets.length / 4);
  for (let tet = 0; tet < volumes.length; tet++) {
    const o = 3 * tets[4 * tet];
    const edge = (corner: number, axis: number) => shape[3 * tets[4 * tet + corner] + axis] - shape[o + axis];
    const [ax, ay, az] = [edge(1, 0), edge(1, 1), edge(1, 2)];
    const [bx, by, bz] = [edge(2, 0), edge(2, 1), edge(2, 2)];
    const [cx, cy, cz] = [edge(3, 0), edge(3, 1), edge(3, 2)];
    volumes[tet] = (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6;
  }
  return volumes;
}

/** Length of the diagonal of the bounding box. */
export function diagonalOf(shape: ArrayLike<number>): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < shape.length; i++) {
    low[i % 3] = Math.min(low[i % 3], shape[i]);
    high[i % 3] = Math.max(high[i % 3], shape[i]);
  }
  return Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

// Faces of a positive tet, counter-clockwise seen from outside.
const FACES = [
  [1, 2, 3],
  [0, 3, 2],
  [0, 1, 3],
  [0, 2, 1],
];

/** Faces that belong to one tet only, outward, in the order of the tets. */
export function boundaryFaces(tets: Int32Array, vertices: number): Uint32Array<ArrayBuffer> {
  const seen = new Map<number, number>(); // sorted corners -> 4 tet + face, or -1 once it has come twice
  if (vertices > 200_000)
    throw new UnreadableModel(
      `The model has ${vertices} vertices, and the page reads files of up to 200,000. Use \`snapspace export --html\`.`,
    );
  const key = (a: number, b: number, c: number) => {
    const low = Math.min(a, b, c);
    const high = Math.max(a, b, c);
    // below 2^53 up to 200,000 vertices; beyond, pairs would collide
    return (low * vertices + (a + b + c - low - high)) * vertices + high;
  };
  for (let corner = 0; corner < tets.length; corner++) {
    const tet = corner >> 2;
    const [i, j, k] = FACES[corner & 3];
    const face = key(tets[4 * tet + i], tets[4 * tet + j], tets[4 * tet + k]);
    seen.set(face, seen.has(face) ? -1 : corner);
  }
  const once = [...seen.values()].filter((corner) => corner >= 0).sort((a, b) => a - b);
  return Uint32Array.from(
    once.flatMap((corner) => FACES[corner & 3].map((i) => tets[4 * (corner >> 2) + i])),
  );
}
