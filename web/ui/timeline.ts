/** How the time from a key to the next is used: slowly at both ends, evenly, or not at all. As in snapspace/timeline. */
export type Easing = "smooth" | "linear" | "hold";
export const EASINGS: readonly Easing[] = ["smooth", "linear", "hold"];

/** A state at a time in seconds, and how the next one is approached. */
export interface Key<State> {
  readonly time: number;
  readonly state: State;
  readonly easing: Easing;
}

/** Times closer than this, in seconds, are the same. */
const SAME = 1e-3;

/** Keys in the order of their times. Every change gives another timeline. */
export class Timeline<State> {
  readonly keys: readonly Key<State>[];
  readonly loop: boolean;

  constructor(keys: readonly Key<State>[] = [], loop = false) {
    this.keys = [...keys].sort((a, b) => a.time - b.time);
    this.loop = loop;
  }

  /** The time of the last key; zero without keys. */
  get end(): number {
    return this.keys.at(-1)?.time ?? 0;
  }

  /** The number of the key at a time, or -1. */
  find(time: number): number {
    return this.keys.findIndex((key) => Math.abs(key.time - time) < SAME);
  }

  /** With a state at a time: in place of the key that is there, or as a new one. */
  with(time: number, state: State): Timeline<State> {
    const at = this.find(time);
    if (at < 0) return new Timeline([...this.keys, { time, state, easing: "smooth" }], this.loop);
    return this.#changed(at, { state });
  }

  /** Without a key. */
  without(number: number): Timeline<State> {
    return new Timeline(
      this.keys.filter((_, k) => k !== number),
      this.loop,
    );
  }

  /** With a key at another time; the timeline itself if another key is there. */
  moved(number: number, time: number): Timeline<State> {
    const other = this.find(time);
    return time < 0 || (other >= 0 && other !== number) ? this : this.#changed(number, { time });
  }

  eased(number: number, easing: Easing): Timeline<State> {
    return this.#changed(number, { easing });
  }

  /** The same keys with other states. */
  map(other: (state: State) => State): Timeline<State> {
    return new Timeline(
      this.keys.map((key) => ({ ...key, state: other(key.state) })),
      this.loop,
    );
  }

  looping(loop: boolean): Timeline<State> {
    return new Timeline(this.keys, loop);
  }

  /** The keys before and after a time, and the share of the way between them; null without keys. */
  at(time: number): { from: State; to: State; share: number } | null {
    if (this.keys.length === 0) return null;
    const next = this.keys.findIndex((key) => key.time > time);
    if (next === 0) return alone(this.keys[0]);
    if (next < 0) return alone(this.keys.at(-1)!);
    const [before, after] = [this.keys[next - 1], this.keys[next]];
    const share = (time - before.time) / (after.time - before.time);
    return { from: before.state, to: after.state, share: eased(share, before.easing) };
  }

  #changed(number: number, part: Partial<Key<State>>): Timeline<State> {
    return new Timeline(
      this.keys.map((key, k) => (k === number ? { ...key, ...part } : key)),
      this.loop,
    );
  }
}

function alone<State>({ state }: Key<State>) {
  return { from: state, to: state, share: 0 };
}

/** The share of the way after a share of the time. */
export function eased(share: number, easing: Easing): number {
  if (easing === "hold") return 0;
  return easing === "smooth" ? share * share * (3 - 2 * share) : share;
}
