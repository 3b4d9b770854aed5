import type { Container } from "./container.ts";
import { boundaryFaces } from "./tets.ts";

/** The surface of a model file: the user's own, or that of its tets. */
export interface FileSurface {
  readonly faces: Uint32Array<ArrayBuffer>;
  /** The tet vertex that each vertex follows most. */
  readonly nearest: ArrayLike<number>;
  /** Rows of 3 numbers per tet vertex, at the surface's vertices. */
  embedded(rows: Float64Array): Float64Array;
}

/** A surface whose vertices are weighted sums of four tet vertices each. */
export function ownSurface(container: Container, vertices: number): FileSurface {
  const [faceCount] = container.shape("surface_faces", 2);
  const [count] = container.shape("surface_corners", 2);
  const corners = container.indices("surface_corners", vertices, [count, 4]);
  const weights = container.doubles("surface_weights", count, 4);
  const nearest = Int32Array.from({ length: count }, (_, vertex) => {
    let most = 4 * vertex;
    for (let i = most + 1; i < 4 * vertex + 4; i++) if (weights[i] > weights[most]) most = i;
    return corners[most];
  });
  return {
    faces: Uint32Array.from(container.indices("surface_faces", count, [faceCount, 3])),
    nearest,
    embedded: (rows) => onSurface(rows, vertices, corners, weights),
  };
}

/** The surface of the tets. */
export function boundary(tets: Int32Array, vertices: number): FileSurface {
  const { surface, faces } = compacted(boundaryFaces(tets, vertices), vertices);
  return { faces, nearest: surface, embedded: (rows) => picked(rows, surface, vertices) };
}

/** The surface of a shell: all of it. */
export function everywhere(triangles: Int32Array, vertices: number): FileSurface {
  const nearest = Int32Array.from({ length: vertices }, (_, vertex) => vertex);
  return { faces: Uint32Array.from(triangles), nearest, embedded: (rows) => rows };
}

/** The vertices that faces use, in order, and the faces numbered by them. */
function compacted(faces: Uint32Array, vertices: number) {
  const number = new Int32Array(vertices).fill(-1);
  faces.forEach((vertex) => (number[vertex] = 0));
  const surface: number[] = [];
  number.forEach((used, vertex) => {
    if (used === 0) number[vertex] = surface.push(vertex) - 1;
  });
  return { surface, faces: Uint32Array.from(faces, (vertex) => number[vertex]) };
}

/** Rows of 3 * vertices numbers, at some of the vertices only. */
function picked(rows: Float64Array, chosen: number[], vertices: number): Float64Array {
  const count = rows.length / (3 * vertices);
  const out = new Float64Array(count * 3 * chosen.length);
  let next = 0;
  for (let row = 0; row < count; row++)
    for (const vertex of chosen)
      for (let axis = 0; axis < 3; axis++) out[next++] = rows[(row * vertices + vertex) * 3 + axis];
  return out;
}

/** Rows of 3 * vertices numbers, at points that are weighted sums of four vertices each. */
function onSurface(
  rows: Float64Array,
  vertices: number,
  corners: Int32Array,
  weights: Float64Array,
): Float64Array {
  const points = corners.length / 4;
  const count = rows.length / (3 * vertices);
  const out = new Float64Array(count * 3 * points);
  for (let row = 0; row < count; row++)
    for (let corner = 0; corner < corners.length; corner++) {
      const to = 3 * (row * points + (corner >> 2));
      const from = 3 * (row * vertices + corners[corner]);
      for (let axis = 0; axis < 3; axis++) out[to + axis] += weights[corner] * rows[from + axis];
    }
  return out;
}
