import { reconstruct, type ShapeSpace } from "../engine/index.ts";

const PAUSE = 60; // milliseconds without another shape
const TERMS_IN_A_SLICE = 300_000; // products; half a millisecond or so

/** The positions of a shape on the processor, for picking: computed in slices once the shape rests, so that a
 * drag never waits for it. */
export class IdleShape {
  readonly #space: ShapeSpace;
  readonly #positions: Float32Array;
  #coefficients: ArrayLike<number> = [];
  #done = 0;
  #timer = 0;

  constructor(space: ShapeSpace) {
    this.#space = space;
    this.#positions = new Float32Array(3 * space.vertices);
  }

  /** Takes another shape. */
  show(coefficients: ArrayLike<number>): void {
    this.#coefficients = coefficients;
    this.#done = 0;
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => this.#slice(), PAUSE);
  }

  get isFresh(): boolean {
    return this.#done === this.#positions.length;
  }

  /** The positions, if need be computed at once. */
  positions(): Float32Array {
    this.#advance(this.#positions.length);
    return this.#positions;
  }

  dispose(): void {
    clearTimeout(this.#timer);
  }

  #slice(): void {
    const size = Math.ceil(TERMS_IN_A_SLICE / Math.max(this.#coefficients.length, 1));
    this.#advance(Math.min(this.#done + size, this.#positions.length));
    if (!this.isFresh) this.#timer = window.setTimeout(() => this.#slice(), 0);
  }

  #advance(end: number): void {
    if (end > this.#done) reconstruct(this.#space, this.#coefficients, this.#positions, this.#done, end);
    this.#done = end;
  }
}
