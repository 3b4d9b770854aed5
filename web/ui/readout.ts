const PAUSE = 200; // milliseconds: numbers that change faster cannot be read, and each change lays the panel out anew

/** Tells something after changes, a few times a second at most: at once after a pause, and always the last state. */
export class Readout {
  readonly #tell: () => void;
  #told = -Infinity;
  #timer = 0;

  constructor(tell: () => void) {
    this.#tell = tell;
  }

  /** Something has changed. */
  ask(): void {
    if (this.#timer) return;
    const wait = this.#told + PAUSE - performance.now();
    if (wait <= 0) this.now();
    else this.#timer = window.setTimeout(() => this.now(), wait);
  }

  now(): void {
    this.dispose();
    this.#told = performance.now();
    this.#tell();
  }

  dispose(): void {
    clearTimeout(this.#timer);
    this.#timer = 0;
  }
}
