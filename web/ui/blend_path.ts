const SECONDS_PER_LEG = 1.6;

/** A walk through all poses and back to the first, slow at each pose. */
export class BlendPath {
  readonly #poses: number;
  #seconds = 0;
  playing = false;

  constructor(poses: number) {
    this.#poses = poses;
  }

  /** Starts where it stopped. */
  play(playing: boolean): void {
    this.playing = playing;
  }

  /** The weights so many seconds later. */
  advance(seconds: number): number[] {
    this.#seconds += Math.min(seconds, 0.1); // after a pause of the browser the path goes on, not ahead
    const way = this.#seconds / SECONDS_PER_LEG;
    const leg = Math.floor(way) % this.#poses;
    const share = eased(way - Math.floor(way));
    return Array.from({ length: this.#poses }, (_, pose) =>
      pose === leg ? 1 - share : pose === (leg + 1) % this.#poses ? share : 0,
    );
  }
}

/** From 0 to 1 with speed and acceleration zero at both ends. */
function eased(t: number): number {
  return t * t * t * (t * (6 * t - 15) + 10);
}
