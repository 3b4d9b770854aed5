import type { BlendingSession, FrameReport } from "../engine/index.ts";
import { EvenWalk } from "./even_walk.ts";
import { MotionProbe } from "./motion_probe.ts";
import { allWeights, type PoseChoice } from "./pose_choice.ts";

const SECONDS_PER_LEG = 1.6; // if the shape moved straight
const FIRST = 1 / 60; // seconds of the first frame
const LONGEST = 0.1; // seconds of a frame: after a pause of the browser the walk continues where it was

interface Frame {
  readonly weights: readonly number[];
  readonly q: Float64Array;
  readonly report: FrameReport | null;
}

/** A jump of the shape on the path to a pose, at this weight of the pose. */
export interface Jump {
  readonly pose: number;
  readonly weight: number;
}

/** A walk from the present shape through the chosen poses, in their order, and again to the first. The vertex that moves
 * most moves as far in every frame. */
export class BlendPath {
  playing = false;
  readonly #session: BlendingSession;
  #probes: { shapes: MotionProbe; poses: MotionProbe } | null = null;
  #walk: EvenWalk<Frame> | null = null;
  #goal = -1;
  #speed = 0; // a length for each second
  #isFresh = true;

  constructor(session: BlendingSession) {
    this.#session = session;
  }

  /** Starts or stops; it starts towards the pose that it was heading for. */
  play(playing: boolean): void {
    this.playing = playing;
    this.#isFresh = true;
    this.restart();
  }

  /** Forgets the walk, because the session has another shape or dimension. */
  restart(): void {
    this.#walk = null;
  }

  /** Solves for the shape `seconds` later; `jump` is null where it did not jump. */
  advance(
    choice: PoseChoice,
    seconds: number,
  ): { choice: PoseChoice; report: FrameReport; jump: Jump | null } {
    const walk = (this.#walk ??= this.#begin(choice));
    // before the first frame of a walk nothing may have been drawn for long
    const time = this.#isFresh ? FIRST : Math.min(Math.max(seconds, 1e-3), LONGEST);
    this.#isFresh = false;
    const gap = walk.step(this.#speed * time);
    const { weights, q } = walk.shape;
    let { report } = walk.shape;
    // the last shape that was tried may not be the one that was taken
    if (!report || !isSame(this.#session.q, q)) report = this.#solve({ ...choice, weights }, q);
    const weight = weights[choice.poses.indexOf(this.#goal)];
    const jump = gap > 0 ? { pose: this.#goal, weight } : null;
    if (walk.share === 1) this.#walk = null;
    return { choice: { ...choice, weights }, report, jump };
  }

  #solve(choice: PoseChoice, start: ArrayLike<number>): FrameReport {
    return this.#session.blend(allWeights(choice, this.#session.model.poses.length), start);
  }

  #begin(choice: PoseChoice): EvenWalk<Frame> {
    const { poses, weights } = choice;
    const goal = Math.max(poses.indexOf(this.#goal), 0);
    // already there: goes to the next one
    const place = weights[goal] > 1 - 1e-9 ? (goal + 1) % poses.length : goal;
    this.#goal = poses[place];
    const { space, poseSpace } = this.#session.model;
    const probes = (this.#probes ??= { shapes: new MotionProbe(space), poses: new MotionProbe(poseSpace) });
    const alone = (pose: number) => allWeights({ poses: [pose], weights: [1] }, poseSpace.scales.length);
    const between = (a: number, b: number) => probes.poses.between(alone(a), alone(b));
    this.#speed = this.#speedOf(poses.map((pose, i) => between(pose, poses[(i + 1) % poses.length])));
    const path = {
      solve: (share: number, from: Frame): Frame => {
        const there = weights.map((w, i) => (i === place ? 1 - (1 - w) * (1 - share) : w * (1 - share)));
        const report = this.#solve({ poses, weights: there }, from.q);
        return { weights: there, q: this.#session.q, report };
      },
      motion: (from: Frame, to: Frame) => probes.shapes.between(from.q, to.q),
    };
    const start = { weights, q: this.#session.q, report: null };
    const length = poses.reduce((sum, pose, i) => sum + weights[i] * between(pose, this.#goal), 0);
    return new EvenWalk(path, start, length);
  }

  /** The speed at which legs take SECONDS_PER_LEG on average, positive even if all poses are alike. */
  #speedOf(legs: readonly number[]): number {
    const mean = legs.reduce((sum, length) => sum + length, 0) / legs.length;
    return Math.max(mean, 1e-3 * this.#session.model.diagonal) / SECONDS_PER_LEG;
  }
}

function isSame(a: ArrayLike<number>, b: ArrayLike<number>): boolean {
  return a.length === b.length && Array.from(a).every((value, i) => value === b[i]);
}
