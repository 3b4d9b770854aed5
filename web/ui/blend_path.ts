const SECONDS_PER_LEG = 1.6;

/** A walk through poses and back to the first, slow at each pose. */
export class BlendPath {
  #seconds = 0;
  playing = false;

  /** Starts where it stopped. */
  play(playing: boolean): void {
    this.playing = playing;
  }

  /** The weights of so many poses, so many seconds later. */
  advance(seconds: number, poses: number): number[] {
    this.#seconds += Math.min(seconds, 0.1); // after a pause of the browser the path goes on, not ahead
    const way = this.#seconds / SECONDS_PER_LEG;
    const leg = Math.floor(way) % poses;
    const share = eased(way - Math.floor(way));
    return Array.from({ length: poses }, (_, pose) =>
      pose === leg ? 1 - share : pose === (leg + 1) % poses ? share : 0,
    );
  }
}

/** From 0 to 1 with speed and acceleration zero at both ends. */
function eased(t: number): number {
  return t * t * t * (t * (6 * t - 15) + 10);
}
