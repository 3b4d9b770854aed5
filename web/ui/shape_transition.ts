/** The duration of a transition, and its longest step between two pictures, in seconds. */
const DURATION = 0.3;
const LONGEST_STEP = 0.05;

/** A smooth transition from a shape to another one that may move meanwhile, both in the coordinates of one model. */
export class ShapeTransition {
  readonly #offset: Float64Array;
  #passed = 0;

  constructor(from: ArrayLike<number>, to: ArrayLike<number>) {
    this.#offset = Float64Array.from(to, (value, i) => from[i] - value);
  }

  get isOver(): boolean {
    return this.#passed >= DURATION;
  }

  /** Lets `seconds` pass. A late picture, such as the first of a model, causes no jump. */
  advance(seconds: number): void {
    this.#passed += Math.min(seconds, LONGEST_STEP);
  }

  /** The shape to show in place of `to`. It begins and ends without speed. */
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
