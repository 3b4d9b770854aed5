import type { Core, FrameReport, Termination } from "./core.ts";
import { applied, transposed, type RigidMap, type Vector } from "./motion.ts";
import { isSame, seenFrom, type RigidFrames } from "./rigid_frames.ts";

/** How a body swings; as Dynamics of the Python package. */
export interface Dynamics {
  /** Frequency of the softest vibration, in Hz. */
  readonly frequency: number;
  /** Share of the critical damping of that vibration. */
  readonly damping: number;
  /** Acceleration in lengths per square second. */
  readonly gravity: Vector;
}

/** Two shapes with a time between them: coordinates, and where the subspace is in the world. */
interface Movement {
  readonly q: Float64Array;
  readonly before: Float64Array;
  readonly frame: RigidMap;
  readonly frameBefore: RigidMap;
  readonly dt: number;
}

/** Steps in time by implicit Euler in reduced coordinates; as TimeSteps of the Python package.
 *
 * A step minimises F(q) + density / (2 dt^2) |q - target|^2, where the target has the coordinates that the body would
 * reach without forces. Where the handles rest, a step never increases the mechanical energy. */
export class TimeSteps {
  dynamics: Dynamics = { frequency: 2, damping: 0.05, gravity: [0, 0, 0] };
  readonly #core: Core;
  readonly #frames: RigidFrames | null;
  readonly #whole: number;
  #movement: Movement | null = null;
  #softest = 0;
  #dimension = 0;

  /** `dimension` is that of the model. */
  constructor(core: Core, frames: RigidFrames | null, dimension: number) {
    this.#core = core;
    this.#frames = frames;
    this.#whole = dimension;
  }

  /** Mass per volume that gives the softest vibration its frequency. */
  get density(): number {
    if (this.#dimension !== this.#core.dimension) {
      this.#softest = this.#core.softest();
      this.#dimension = this.#core.dimension;
    }
    return this.#softest / (2 * Math.PI * this.dynamics.frequency) ** 2;
  }

  /** The movement up to now; none if the shape is not that of the last step. */
  moving(frame: RigidMap): Movement {
    const { q } = this.#core;
    const last = this.#movement;
    if (last && last.q.length === q.length && last.q.every((x, i) => x === q[i]) && isSame(last.frame, frame))
      return last;
    return { q, before: q, frame, frameBefore: frame, dt: 1 };
  }

  /** The body no longer moves. */
  stop(): void {
    this.#movement = null;
  }

  /** Speed of the coordinates, per second. */
  speed(frame: RigidMap): number {
    const { q, before, dt } = this.moving(frame);
    return Math.sqrt(squareOf(q, before)) / dt;
  }

  /** Steps from `last` to the motions or weights that are set in the core. */
  advance(last: Movement, frame: RigidMap, dt: number, stop: Termination): FrameReport {
    const target = this.#target(last, frame, dt);
    const { report, before } = this.#core.step(this.density / dt ** 2, target, stop);
    if (report.status === "not_finite") this.#core.q = last.q;
    else {
      const next = { q: this.#core.q, before: last.q, frame, frameBefore: last.frame, dt };
      this.#movement = this.#limited(last, next, before, report.value);
    }
    return report;
  }

  /** Where the body would be after dt without elastic forces, seen from the new frame. */
  #target(last: Movement, frame: RigidMap, dt: number): Float64Array {
    const { frequency, damping } = this.dynamics;
    const kept = (Math.exp(-4 * Math.PI * damping * frequency * dt) * dt) / last.dt;
    const seen = (q: Float64Array, old: RigidMap) => seenFrom(this.#frames, this.#whole, q, old, frame);
    const [now, before] = [seen(last.q, last.frame), seen(last.before, last.frameBefore)];
    const weight = this.#weight(frame, now.length);
    return now.map((x, i) => x + kept * (x - before[i]) + dt ** 2 * weight[i]);
  }

  /** Acceleration of the coordinates by gravity. */
  #weight(frame: RigidMap, dimension: number): Float64Array {
    const weight = new Float64Array(dimension);
    if (!this.#frames) return weight;
    const gravity = applied(transposed(frame.rotation), this.dynamics.gravity);
    for (let a = 0; a < 3; a++)
      for (let i = 0; i < dimension; i++) weight[i] += gravity[a] * this.#frames.ones[a * this.#whole + i];
    return weight;
  }

  /** Shortens the velocity if the mechanical energy would grow. */
  #limited(last: Movement, next: Movement, before: number, after: number): Movement {
    if (!isSame(last.frameBefore, next.frame) || !isSame(last.frame, next.frame)) return next; // the frame does work
    const { density } = this;
    const weight = this.#weight(next.frame, next.q.length);
    let fall = 0;
    next.q.forEach((x, i) => (fall += density * weight[i] * (x - last.q[i])));
    const kineticOf = ({ q, before, dt }: Movement) => (density / 2 / dt ** 2) * squareOf(q, before);
    const left = Math.max(before - after + kineticOf(last) + fall, 0);
    const kinetic = kineticOf(next);
    if (kinetic <= left) return next;
    const share = Math.sqrt(left / kinetic);
    return { ...next, before: next.q.map((x, i) => x - share * (x - next.before[i])) };
  }
}

function squareOf(a: Float64Array, b: Float64Array): number {
  return a.reduce((sum, x, i) => sum + (x - b[i]) ** 2, 0);
}
