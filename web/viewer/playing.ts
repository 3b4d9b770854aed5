import { timelineOf, type States } from "../ui/timeline_file.ts";
import type { Timeline } from "../ui/timeline.ts";

const LONGEST_FRAME = 0.1; // seconds: after a pause of the browser the film continues where it was

/** Plays the timeline that a model was saved with. */
export class Playing<State> {
  readonly #timeline: Timeline<State> | null;
  readonly #states: States<State>;
  readonly #show: (state: State) => void;
  #time = 0;
  #isOn = false;

  constructor(given: unknown, states: States<State>, show: (state: State) => void) {
    this.#timeline = given === undefined ? null : timelineOf(given, states);
    [this.#states, this.#show] = [states, show];
  }

  /** Whether there is a timeline with something to play. */
  get isPossible(): boolean {
    return (this.#timeline?.keys.length ?? 0) > 1;
  }

  get isOn(): boolean {
    return this.#isOn;
  }

  /** Throws an Error without a timeline. */
  set isOn(on: boolean) {
    if (on && !this.isPossible) throw new Error("The model has no timeline; save it with one.");
    if (on && this.#time >= this.#timeline!.end) this.#time = 0;
    this.#isOn = on;
  }

  /** Before a picture: asks for the next state. */
  advance(seconds: number): void {
    if (!this.#isOn) return;
    const { keys, end, loop } = this.#timeline!;
    const first = keys[0].time;
    this.#time = Math.max(this.#time, first) + Math.min(seconds, LONGEST_FRAME);
    if (this.#time >= end && loop) this.#time = first + ((this.#time - first) % (end - first));
    const { from, to, share } = this.#timeline!.at(this.#time)!;
    this.#show(share === 0 ? from : this.#states.between(from, to, share));
    if (this.#time >= end) this.#isOn = false;
  }
}
