/** A path from share 0 to share 1 with a shape at each share. */
export interface ShapePath<Shape> {
  /** The shape at a share, solved for from the shape at one before it. */
  solve(share: number, from: Shape): Shape;
  /** The largest motion of a vertex between two shapes. */
  motion(from: Shape, to: Shape): number;
}

/** The shortest step, however far it moves the shape. */
export const LEAST_STEP = 1e-4;
const MOST_STEP = 0.25; // where the shape rests: a frame takes no larger share of the path
const JUMP = 4; // even steps
const [SMALL, LARGE] = [0.8, 1.25]; // shares of an even step: differences that are not visible
const GROWTHS = 3; // per step: a pace that is too slow is corrected over a few frames

interface PathPoint<Shape> {
  readonly share: number;
  readonly shape: Shape;
}

/** Walks a path by even motions of the shape: where it moves fast, shares grow slowly.
 *
 * A step solves once or twice where the shape moves smoothly. One that moves it too far is halved down to LEAST_STEP,
 * so that no step solves more than 18 times. What still moves it farther than JUMP even steps is a jump: the energy has
 * no minimum between. */
export class EvenWalk<Shape> {
  readonly #path: ShapePath<Shape>;
  #at: PathPoint<Shape>;
  #pace: number; // shares for a motion

  /** `length` is about how far the shape will move on the whole path. */
  constructor(path: ShapePath<Shape>, start: Shape, length: number) {
    this.#path = path;
    this.#at = { share: 0, shape: start };
    this.#pace = length > 0 ? 1 / length : Infinity;
  }

  get share(): number {
    return this.#at.share;
  }

  get shape(): Shape {
    return this.#at.shape;
  }

  /** Takes a step that moves the shape by about `even`, or less at the end of the path. Returns how far it jumped, else zero. */
  step(even: number): number {
    const from = this.#at;
    const last = Math.min(from.share + MOST_STEP, 1);
    const within = (step: number) => Math.min(from.share + Math.max(step, LEAST_STEP), last);
    let [near, moved, growths] = [from, 0, 0];
    let far: PathPoint<Shape> | null = null;
    let share = within(this.#pace * even);
    for (;;) {
      const tried = { share, shape: this.#path.solve(share, near.shape) };
      const motion = this.#path.motion(from.shape, tried.shape);
      const isFirst = far === null;
      if (motion > LARGE * even) far = tried;
      else [near, moved] = [tried, motion];
      if (moved >= SMALL * even) break;
      if (far) {
        if (far.share - near.share <= 1.001 * LEAST_STEP) return this.#cross(from, near, far, even);
        const middle = (near.share + far.share) / 2;
        // the first time as if it moved evenly; what jumps does not, and is bracketed by halves
        share = isFirst && motion > 0 ? within(((share - from.share) * even) / motion) : middle;
        if (share <= near.share || share >= far.share) share = middle;
      } else {
        if (share === last || growths++ === GROWTHS) break;
        share = within((share - from.share) * Math.min((even / motion) * 0.98, 4));
      }
    }
    this.#go(from, near, moved);
    return 0;
  }

  /** Between `near` and `far` there is no smaller step. */
  #cross(from: PathPoint<Shape>, near: PathPoint<Shape>, far: PathPoint<Shape>, even: number): number {
    const gap = this.#path.motion(near.shape, far.shape);
    const isJump = gap > JUMP * even;
    const reached = isJump ? near : far; // a jump says nothing about the pace
    this.#go(from, reached, this.#path.motion(from.shape, reached.shape));
    this.#at = far;
    return isJump ? gap : 0;
  }

  #go(from: PathPoint<Shape>, to: PathPoint<Shape>, moved: number): void {
    const step = to.share - from.share;
    if (step > 0) this.#pace = Math.min(step / moved, 4 * this.#pace);
    this.#at = to;
  }
}
