import type { Vector } from "./motion.ts";
import type { TriangleTree } from "./triangle_tree.ts";

/** Which vertices a tool takes. Shapes are x0 y0 z0 x1 ..., places on the screen x0 y0 x1 ... in pixels. */

export type ScreenPoint = readonly [x: number, y: number];

export const NOTHING: Int32Array = new Int32Array(0);

/** Vertices in a ball, those on its surface too. */
export function inBall(shape: Float32Array, [x, y, z]: Vector, radius: number): Int32Array {
  const square = radius * radius;
  return where(shape.length / 3, (vertex) => {
    const dx = shape[3 * vertex] - x;
    const dy = shape[3 * vertex + 1] - y;
    const dz = shape[3 * vertex + 2] - z;
    return dx * dx + dy * dy + dz * dz <= square;
  });
}

/** The vertex nearest to a place. */
export function nearestTo(shape: Float32Array, [x, y, z]: Vector): Int32Array {
  let [nearest, least] = [0, Infinity];
  for (let i = 0; i < shape.length; i += 3) {
    const square = (shape[i] - x) ** 2 + (shape[i + 1] - y) ** 2 + (shape[i + 2] - z) ** 2;
    if (square < least) [nearest, least] = [i / 3, square];
  }
  return Int32Array.of(nearest);
}

/** Where a camera shows vertices: `matrix` takes them to clip space (column by column). NaN behind the camera. */
export function placesOf(
  shape: Float32Array,
  matrix: readonly number[],
  width: number,
  height: number,
): Float32Array {
  const places = new Float32Array((2 * shape.length) / 3);
  const m = matrix;
  for (let from = 0, to = 0; from < shape.length; from += 3, to += 2) {
    const x = shape[from];
    const y = shape[from + 1];
    const z = shape[from + 2];
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    const scale = w > 0 ? 0.5 / w : NaN;
    places[to] = width * (0.5 + scale * (m[0] * x + m[4] * y + m[8] * z + m[12]));
    places[to + 1] = height * (0.5 - scale * (m[1] * x + m[5] * y + m[9] * z + m[13]));
  }
  return places;
}

/** Vertices in the rectangle with two opposite corners. */
export function inRectangle(places: Float32Array, a: ScreenPoint, b: ScreenPoint): Int32Array {
  const [left, right] = a[0] < b[0] ? [a[0], b[0]] : [b[0], a[0]];
  const [top, bottom] = a[1] < b[1] ? [a[1], b[1]] : [b[1], a[1]];
  return where(places.length / 2, (vertex) => {
    const x = places[2 * vertex];
    const y = places[2 * vertex + 1];
    return x >= left && x <= right && y >= top && y <= bottom;
  });
}

/** Vertices in a closed line. What it goes around twice is inside too: the winding number decides. */
export function inLasso(places: Float32Array, line: readonly ScreenPoint[]): Int32Array {
  if (line.length < 3) return new Int32Array(0);
  const xs = Float64Array.from(line, ([x]) => x);
  const ys = Float64Array.from(line, ([, y]) => y);
  const bounds: [ScreenPoint, ScreenPoint] = [
    [Math.min(...xs), Math.min(...ys)],
    [Math.max(...xs), Math.max(...ys)],
  ];
  return inRectangle(places, ...bounds).filter((vertex) => {
    const x = places[2 * vertex];
    const y = places[2 * vertex + 1];
    let winding = 0;
    for (let i = xs.length - 1, j = 0; j < xs.length; i = j++) {
      if (ys[i] <= y === ys[j] <= y) continue;
      const side = (xs[j] - xs[i]) * (y - ys[i]) - (x - xs[i]) * (ys[j] - ys[i]);
      if (side > 0 === ys[i] <= y) winding += ys[i] <= y ? 1 : -1;
    }
    return winding !== 0;
  });
}

// A share of the distance to the eye: nearer hits are the vertex's own triangles.
const TOUCHING = 1e-4;

/** Those of some vertices that are on the surface, and that nothing hides from the eye. */
export function seenFrom(
  eye: Vector,
  tree: TriangleTree,
  shape: Float32Array,
  faces: Uint32Array,
  vertices: Int32Array,
): Int32Array {
  const turned = facing(eye, shape, faces);
  return vertices.filter((vertex) => {
    if (turned[vertex] === 0) return false;
    const [x, y, z] = [shape[3 * vertex], shape[3 * vertex + 1], shape[3 * vertex + 2]];
    return !tree.isBlocked([x, y, z], [eye[0] - x, eye[1] - y, eye[2] - z], TOUCHING, 1);
  });
}

/** 1 for the vertices of triangles whose outer side is towards the eye. */
function facing([ex, ey, ez]: Vector, shape: Float32Array, faces: Uint32Array): Uint8Array {
  const marks = new Uint8Array(shape.length / 3);
  for (let f = 0; f < faces.length; f += 3) {
    const [a, b, c] = [3 * faces[f], 3 * faces[f + 1], 3 * faces[f + 2]];
    const [ax, ay, az] = [shape[a], shape[a + 1], shape[a + 2]];
    const [ux, uy, uz] = [shape[b] - ax, shape[b + 1] - ay, shape[b + 2] - az];
    const [vx, vy, vz] = [shape[c] - ax, shape[c + 1] - ay, shape[c + 2] - az];
    const outwards =
      (uy * vz - uz * vy) * (ex - ax) + (uz * vx - ux * vz) * (ey - ay) + (ux * vy - uy * vx) * (ez - az);
    if (outwards > 0) for (let corner = f; corner < f + 3; corner++) marks[faces[corner]] = 1;
  }
  return marks;
}

/** All of the first, and the others. Vertices come and go in ascending order. */
export function union(a: Int32Array, b: Int32Array): Int32Array {
  const merged = new Int32Array(a.length + b.length);
  let [i, j, size] = [0, 0, 0];
  while (i < a.length || j < b.length) {
    const next = j === b.length || a[i] < b[j] ? a[i] : b[j];
    if (a[i] === next) i++;
    if (b[j] === next) j++;
    merged[size++] = next;
  }
  return merged.slice(0, size);
}

/** All of the first that are not among the others. Vertices come and go in ascending order. */
export function without(a: Int32Array, b: Int32Array): Int32Array {
  let j = 0;
  return a.filter((vertex) => {
    while (j < b.length && b[j] < vertex) j++;
    return b[j] !== vertex;
  });
}

function where(count: number, isIn: (vertex: number) => boolean): Int32Array {
  const found = new Int32Array(count);
  let size = 0;
  for (let vertex = 0; vertex < count; vertex++) if (isIn(vertex)) found[size++] = vertex;
  return found.slice(0, size);
}
