import type { ShapeSpace } from "../engine/index.ts";

const MOST_EVENLY = 400;

/** Measures how far a shape moves between two frames at few vertices, so that the cost does not grow with the surface:
 * some spread evenly, and for each mode the vertex that it moves most. */
export class MotionProbe {
  readonly #vertices: number;
  /** One mode after the other, scaled, each 3 numbers per vertex. */
  readonly #modes: Float32Array;

  constructor({ vertices, modes, scales }: ShapeSpace) {
    const taken = new Set<number>();
    const evenly = Math.min(vertices, MOST_EVENLY);
    for (let i = 0; i < evenly; i++) taken.add(Math.floor((i * vertices) / evenly));
    if (evenly < vertices)
      scales.forEach((_, mode) =>
        taken.add(farthest(modes.subarray(3 * vertices * mode, 3 * vertices * (mode + 1)))),
      );
    const rows = [...taken].flatMap((vertex) => [3 * vertex, 3 * vertex + 1, 3 * vertex + 2]);
    this.#vertices = taken.size;
    this.#modes = new Float32Array(rows.length * scales.length);
    scales.forEach((scale, mode) => {
      const start = 3 * vertices * mode;
      this.#modes.set(
        rows.map((row) => scale * modes[start + row]),
        rows.length * mode,
      );
    });
  }

  /** The largest motion of a vertex between two shapes, given by their coefficients. */
  between(from: ArrayLike<number>, to: ArrayLike<number>): number {
    const size = 3 * this.#vertices;
    const moved = new Float64Array(size);
    for (let mode = 0; mode < to.length; mode++) {
      const change = to[mode] - from[mode];
      const start = size * mode;
      for (let i = 0; i < size; i++) moved[i] += change * this.#modes[start + i];
    }
    return largest(moved);
  }
}

/** The length of the longest of vectors, 3 numbers each. */
function largest(vectors: ArrayLike<number>): number {
  return Math.sqrt(squareOf(vectors, farthest(vectors)));
}

/** Which of vectors is the longest. */
function farthest(vectors: ArrayLike<number>): number {
  let [best, most] = [0, -1];
  for (let vertex = 0; vertex < vectors.length / 3; vertex++) {
    const square = squareOf(vectors, vertex);
    if (square > most) [best, most] = [vertex, square];
  }
  return best;
}

function squareOf(vectors: ArrayLike<number>, vertex: number): number {
  const [x, y, z] = [vectors[3 * vertex], vectors[3 * vertex + 1], vectors[3 * vertex + 2]];
  return x * x + y * y + z * z;
}
