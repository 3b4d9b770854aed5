const PAUSE = 200; // milliseconds: numbers that change faster cannot be read, and each change lays out some of the page
const REST = 800; // milliseconds without a change, where no picture comes: then all parts are updated

/** Updates texts that change with the pictures of a drag: one of them before a picture, a few times a second at most, so
 * that no picture waits for all of them. The last update always shows the last state. */
export class Readout {
  readonly #parts: readonly (() => boolean)[];
  readonly #isDue: boolean[];
  #next = 0;
  #shown = 0;
  #asked = 0;
  #timer = 0;

  /** Each part updates something, and returns whether it has changed. */
  constructor(...parts: (() => boolean)[]) {
    this.#parts = parts;
    this.#isDue = parts.map(() => false);
  }

  /** Notes that something has changed. */
  ask(): void {
    this.#isDue.fill(true);
    this.#asked = performance.now();
    if (!this.#timer) this.#timer = window.setTimeout(() => this.#rest(), REST);
  }

  /** Before a picture: updates the next part that has changed. */
  advance(): void {
    const { length } = this.#parts;
    const now = performance.now();
    if (now - this.#shown < PAUSE / length) return;
    for (let tried = 0; tried < length; tried++) {
      const part = this.#next;
      this.#next = (part + 1) % length;
      if (!this.#isDue[part]) continue;
      this.#isDue[part] = false;
      if (!this.#parts[part]()) continue;
      this.#shown = now;
      return;
    }
  }

  /** Updates all parts, as after a click. */
  now(): void {
    this.dispose();
    this.#shown = performance.now();
    this.#isDue.fill(false);
    for (const part of this.#parts) part();
  }

  dispose(): void {
    clearTimeout(this.#timer);
    this.#timer = 0;
  }

  #rest(): void {
    const wait = this.#asked + REST - performance.now();
    if (wait > 0) this.#timer = window.setTimeout(() => this.#rest(), wait);
    else this.now();
  }
}
