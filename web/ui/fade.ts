/** How long a shape takes to go over into another one, and the most of it between two pictures, in seconds. */
const DURATION = 0.3;
const LONGEST_STEP = 0.05;

/** The way from a shape to another that moves meanwhile, both in the coordinates of one model. */
export class Fade {
  readonly #offset: Float64Array;
  #passed = 0;

  constructor(from: ArrayLike<number>, to: ArrayLike<number>) {
    this.#offset = Float64Array.from(to, (value, i) => from[i] - value);
  }

  get isOver(): boolean {
    return this.#passed >= DURATION;
  }

  /** So many seconds pass. A picture that comes late, as the first of a model does, is no jump. */
  advance(seconds: number): void {
    this.#passed += Math.min(seconds, LONGEST_STEP);
  }

  /** What is shown in place of the shape that it goes over into: it begins and ends without speed. */
  at(to: ArrayLike<number>): Float64Array {
    const share = Math.min(this.#passed / DURATION, 1);
    const left = 1 - share * share * (3 - 2 * share);
    return Float64Array.from(to, (value, i) => value + left * (this.#offset[i] ?? 0));
  }
}

/** Coordinates of a shape in a better model, by the matrix of what one model's modes are in the other's. */
export function carriedOver(matrix: Float32Array, q: Float64Array): Float64Array {
  const columns = q.length;
  return Float64Array.from({ length: matrix.length / columns }, (_, row) => {
    let sum = 0;
    for (let i = 0; i < columns; i++) sum += matrix[row * columns + i] * q[i];
    return sum;
  });
}
