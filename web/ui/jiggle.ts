import type { Dynamics, FrameReport } from "../engine/index.ts";

/** Seconds of one step, and the most steps of a picture. */
const DT = 1 / 60;
const MOST_STEPS = 4;
/** A body rests once it is slower than this, in coordinate scales per second, for this many steps: it is slow for a
 * moment at each end of a swing, and never slower than the tolerance of the solves. */
const RESTING = 0.05;
const STILL = 12;

/** What swings: a session, with what is asked of it. */
export interface Swinging {
  /** One step in time. */
  step(dt: number, dynamics: Dynamics): FrameReport;
  /** The static solve for what is set, where a swing without gravity ends. */
  settle(): FrameReport;
  /** The speed in coordinate scales per second. */
  speed(): number;
}

/** Runs steps in time as fast as time passes, until the body rests. */
export class Jiggle {
  dynamics: Dynamics = { frequency: 2, damping: 0.05, gravity: [0, 0, 0] };
  readonly #swinging: Swinging;
  #isOn = false;
  #moves = false;
  #waiting = 0; // seconds that have not been stepped
  #isFirst = false;
  #still = 0; // steps since it moved

  constructor(swinging: Swinging) {
    this.#swinging = swinging;
  }

  get isOn(): boolean {
    return this.#isOn;
  }

  /** Off, the body goes to where it would rest without gravity. */
  set isOn(on: boolean) {
    this.#isOn = on;
    if (!on && this.#moves) this.#isFirst = true;
  }

  /** Whether gravity bends the body, which static solutions ignore. */
  get isHeavy(): boolean {
    return this.#isOn && this.dynamics.gravity.some((g) => g !== 0);
  }

  /** Whether more pictures are needed. */
  get moves(): boolean {
    return this.#moves;
  }

  /** Something was asked for: the body begins to move. */
  wake(): void {
    this.#isFirst = !this.#moves;
    this.#moves = true;
  }

  /** Before each picture: the steps that are due; null if none is. `seconds` is the time since the last picture. */
  advance(seconds: number): FrameReport | null {
    if (!this.#moves) return null;
    if (!this.#isOn) {
      this.#moves = false;
      return this.#swinging.settle();
    }
    // half a step ahead, so that uneven pictures still have one step each
    this.#waiting = this.#isFirst ? 1.5 * DT : Math.min(this.#waiting + seconds, MOST_STEPS * DT);
    this.#isFirst = false;
    let report: FrameReport | null = null;
    while (this.#waiting >= DT) {
      this.#waiting -= DT;
      report = this.#swinging.step(DT, this.dynamics);
      this.#still = this.#swinging.speed() < RESTING ? this.#still + 1 : 0;
      if (this.#still === STILL) {
        this.#still = 0;
        this.#moves = false;
        return this.isHeavy ? report : this.#swinging.settle();
      }
    }
    return report;
  }
}
