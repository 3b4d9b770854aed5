/** States to return to. A state that is the same as the present one is no step. */
export class History<T> {
  #past: T[] = [];
  #future: T[] = [];
  #present: T;
  readonly #isSame: (a: T, b: T) => boolean;

  constructor(present: T, isSame: (a: T, b: T) => boolean = Object.is) {
    [this.#present, this.#isSame] = [present, isSame];
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /** All states, from the first one to the last that was undone. */
  get states(): T[] {
    return [...this.#past, this.#present, ...this.#future.toReversed()];
  }

  /** Every state becomes another one; the steps stay. */
  map(other: (state: T) => T): void {
    this.#past = this.#past.map(other);
    this.#future = this.#future.map(other);
    this.#present = other(this.#present);
  }

  push(state: T): void {
    if (this.#isSame(state, this.#present)) return;
    this.#past.push(this.#present);
    if (this.#past.length > 200) this.#past.shift();
    this.#present = state;
    this.#future = [];
  }

  undo(): T | undefined {
    return this.#step(this.#past, this.#future);
  }

  redo(): T | undefined {
    return this.#step(this.#future, this.#past);
  }

  #step(from: T[], to: T[]): T | undefined {
    const state = from.pop();
    if (state === undefined) return undefined;
    to.push(this.#present);
    this.#present = state;
    return state;
  }
}
