import { triangleNormals } from "../engine/triangles.ts";
import { rings } from "./rings.ts";

/** The cosine below which faces meet at a sharp edge, squared: 50 degrees, as in snapspace/pictures/normals.py. */
const SHARP = Math.cos((50 * Math.PI) / 180) ** 2;

/** A surface whose vertices have a point on each side of their sharp edges. */
export interface SharpEdges {
  /** The vertex of each point; the first points are the vertices. */
  readonly points: Int32Array<ArrayBuffer>;
  readonly triangles: Uint32Array<ArrayBuffer>;
  /** `rings` of the points of vertices with several sides, in vertices; other points have none. */
  readonly ranges: Int32Array<ArrayBuffer>;
  readonly pairs: Int32Array<ArrayBuffer>;
}

/** The sides of sharp edges; null where no vertex has several. Two faces at a vertex are on the same side if smooth ones
 * lead from one to the other: an edge that ends within a smooth surface splits nothing. */
export function sharpEdges(shape: Float32Array, faces: Uint32Array<ArrayBuffer>): SharpEdges | null {
  const [latest, sides] = [new Int32Array(shape.length / 3).fill(-1), sidesOf(shape, faces)];
  const points = [...latest.keys()];
  const numbers = new Int32Array(faces.length).fill(-1);
  const triangles = faces.map((vertex, corner) => {
    const side = sides(corner);
    if (numbers[side] < 0) numbers[side] = latest[vertex] < 0 ? vertex : points.push(vertex) - 1;
    latest[vertex] = corner;
    return numbers[side];
  });
  if (points.length === latest.length) return null;
  const { ranges, pairs } = rings(triangles, points.length);
  const split = new Set(points.slice(latest.length));
  points.forEach((vertex, point) => split.has(vertex) || (ranges[2 * point + 1] = 0));
  return {
    points: Int32Array.from(points),
    triangles,
    ranges,
    pairs: pairs.map((point) => points[point]),
  };
}

/** The number of the side on which a corner of a face is. */
function sidesOf(shape: Float32Array, faces: Uint32Array): (corner: number) => number {
  const normals = triangleNormals(shape, faces);
  const dot = (n: number, m: number) =>
    normals[n] * normals[m] + normals[n + 1] * normals[m + 1] + normals[n + 2] * normals[m + 2];
  const latest = new Int32Array(shape.length / 3).fill(-1);
  const before = new Int32Array(faces.length);
  const parents = before.map((_, corner) => corner);
  const root = (corner: number) => {
    while (parents[corner] !== corner) corner = parents[corner] = parents[parents[corner]];
    return corner;
  };
  faces.forEach((vertex, corner) => {
    const n = corner - (corner % 3);
    for (let other = latest[vertex]; other >= 0; other = before[other]) {
      const m = other - (other % 3);
      const along = dot(n, m);
      if (along > 0 && along ** 2 > SHARP * dot(n, n) * dot(m, m)) parents[root(other)] = root(corner);
    }
    before[corner] = latest[vertex];
    latest[vertex] = corner;
  });
  return root;
}

/** Copies rows of 3 numbers from vertices to their further points: those after the first `vertices`. */
export function copyRows(rows: Float32Array | Int32Array, points: Int32Array, vertices: number): void {
  for (let point = vertices; point < points.length; point++)
    rows.copyWithin(3 * point, 3 * points[point], 3 * points[point] + 3);
}
