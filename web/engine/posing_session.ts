import { Certifier, type Certificate } from "./certificate.ts";
import { Core, type FrameReport, type Termination } from "./core.ts";
import type { PosingModel } from "./model.ts";
import {
  applied,
  eulerOfRotation,
  IDENTITY,
  minus,
  motionOfMap,
  plus,
  product,
  rotationOfEuler,
  transposed,
  type RigidMap,
  type Rotation,
  type Vector,
} from "./motion.ts";
import { Pulls, type PulledPoint } from "./pulls.ts";
import { beyondBox } from "./sampled_box.ts";
import { TimeSteps } from "./time_steps.ts";

const WARMING = 8; // solves
const WARMING_SHARE = 0.05; // share of the diagonal

/** A motion of a handle from rest, about its centroid. */
export interface Motion {
  readonly rotation: Rotation;
  readonly translation: Vector;
}

/** Poses of a reduced model: move handles, read q. As PosingSession of the Python package. */
export class PosingSession {
  readonly model: PosingModel;
  readonly #core: Core;
  readonly #stop: Termination;
  readonly #certifier: Certifier | null;
  /** Frequency, damping and gravity of `step`. */
  readonly time: TimeSteps;
  #maps: readonly RigidMap[] = [];
  /** Motions relative to the first handle. */
  #relative: readonly Motion[] = [];
  /** Their offsets, see `offsetsOf`. */
  #offsets: readonly number[] = [];
  #outside: { handle: number; how: string }[] | null = null;

  static async create(module: WebAssembly.Module, model: PosingModel): Promise<PosingSession> {
    return new PosingSession(model, await Core.create(module, model));
  }

  private constructor(model: PosingModel, core: Core) {
    this.model = model;
    this.#core = core;
    this.#certifier = Certifier.of(model, core);
    this.time = new TimeSteps(core, model.frames, model.dimension);
    const { valueScale } = core;
    const { coordinateScale } = model;
    this.#stop = { tolerance: 1e-7, valueScale, coordinateScale, maxIterations: 300, maxEvaluations: 500 };
    this.reset();
  }

  get dimension(): number {
    return this.#core.dimension;
  }

  set dimension(dimension: number) {
    this.#core.dimension = dimension;
  }

  /** Reduced coordinates of the shape, as many as `dimension`. */
  get q(): Float64Array {
    return this.#core.q;
  }

  /** The first handle's motion, which carries the shape tau + U q along. */
  get carriedBy(): RigidMap {
    return this.#maps[0];
  }

  motion(handle: number): Motion {
    return motionOfMap(this.#maps[handle], this.model.handles[handle].center);
  }

  /** The requested position of the handle's centroid. */
  place(handle: number): Vector {
    return plus(this.model.handles[handle].center, this.motion(handle).translation);
  }

  /** Sets the motion of a handle from rest, with Euler angles in radians, and solves. */
  move(handle: number, euler: Vector, translation: Vector): FrameReport {
    return this.moveAll(new Map([[handle, { rotation: rotationOfEuler(euler), translation }]]));
  }

  /** Sets the motions of some handles from rest, and solves once. Motions whose energy is not finite are undone.
   * After a jump to motions that are nearer to rest than to the last ones, the solve starts at rest: from a far shape
   * it could take hundreds of iterations. */
  moveAll(motions: ReadonlyMap<number, Motion>): FrameReport {
    const [before, last] = [this.#maps, this.#offsets];
    this.#set(this.#mapsOf(motions));
    if (this.#distance(last) > this.#distance([])) this.#core.q = new Float64Array(this.dimension);
    const report = this.solve();
    if (report.status === "not_finite") this.#set(before); // such motions are never nearer to rest
    return report;
  }

  /** Returns to a frame that was solved before: motions of all handles from rest, and its coordinates. */
  restore(motions: readonly Motion[], q: ArrayLike<number>): void {
    this.#set(this.#mapsOf(new Map(motions.entries())));
    this.#core.q = q;
  }

  /** Advances time by dt seconds, in which some handles get new motions from rest: the body swings after them. */
  step(dt: number, motions: ReadonlyMap<number, Motion> = new Map()): FrameReport {
    const [before, last] = [this.#maps, this.time.moving(this.#maps[0])];
    if (motions.size > 0) this.#set(this.#mapsOf(motions));
    const report = this.time.advance(last, this.#maps[0], dt, this.#stop);
    if (report.status === "not_finite") this.#set(before);
    return report;
  }

  /** Speed of the coordinates in units of `coordinateScale`, per second; zero unless the last frame was a step. */
  get speed(): number {
    return this.time.speed(this.#maps[0]) / this.model.coordinateScale;
  }

  /** Solves for the present motions, from the present shape. */
  solve(): FrameReport {
    this.time.stop();
    return this.#core.solve(this.#stop);
  }

  /** How far the shape is from the full solution; null if the model has no estimate, or if the body swings. */
  certificate(): Certificate | null {
    return this.speed > 0 ? null : (this.#certifier?.certify() ?? null);
  }

  /** Back to rest. */
  reset(): void {
    this.#set(this.model.handles.map(() => IDENTITY));
    this.#core.q = new Float64Array(this.dimension);
  }

  /** Solves small motions and forgets them, at rest: the browser makes fast code of what has run a few times, and the
   * first drag should not wait for that. `follow` does what follows a solve. */
  warmUp(follow: () => void = () => {}): void {
    const { handles, diagonal } = this.model;
    for (let step = 1; step <= WARMING; step++) {
      const shift = (WARMING_SHARE * step * diagonal) / WARMING;
      this.move(handles.length - 1, [0, 0, 0], [shift, 0, 0]);
      follow();
    }
    this.reset();
    this.dimension = this.dimension; // so that nothing of it stays in the core
  }

  /** The handles outside of the box of motions that was sampled, and how. */
  get outside(): readonly { handle: number; how: string }[] {
    return (this.#outside ??= this.#relative.flatMap(({ rotation, translation }, handle) => {
      const how = handle > 0 && beyondBox(this.model.boxes[handle], rotation, translation);
      return how ? { handle, how } : [];
    }));
  }

  /** Euler angles of a handle's motion, in radians. */
  euler(handle: number): Vector {
    return eulerOfRotation(this.#maps[handle].rotation);
  }

  /** Points that are pulled; this session's own shape stays. */
  pulls(module: WebAssembly.Module, points: readonly PulledPoint[]): Promise<Pulls> {
    return Pulls.create(module, this.model, points, this.#stop);
  }

  /** Solves for pulled points beside the present handles. */
  solvePulled(pulls: Pulls): FrameReport {
    return pulls.solve(this.#offsets, this.carriedBy);
  }

  /** Distance of the present offsets of all handles from others, or from rest for []. A turn counts with the body's
   * size. */
  #distance(from: readonly number[]): number {
    const unit = (i: number) => (i % 4 === 3 ? 1 : this.model.diagonal);
    return Math.hypot(...this.#offsets.map((x, i) => unit(i) * (x - (from[i] ?? 0))));
  }

  #mapsOf(motions: ReadonlyMap<number, Motion>): readonly RigidMap[] {
    return this.#maps.map((map, handle) => {
      const motion = motions.get(handle);
      if (!motion) return map;
      const { center } = this.model.handles[handle];
      const shift = minus(plus(center, motion.translation), applied(motion.rotation, center));
      return { rotation: motion.rotation, shift };
    });
  }

  #set(maps: readonly RigidMap[]): void {
    const relative = maps.map((map, handle) =>
      // most handles do not change in a drag
      map === this.#maps[handle] && maps[0] === this.#maps[0]
        ? this.#relative[handle]
        : relativeMotion(maps[0], map, this.model.handles[handle].center),
    );
    const offsets = offsetsOf(relative);
    this.#core.setOffsets(offsets); // throws for numbers that are not finite
    [this.#maps, this.#relative, this.#offsets] = [maps, relative, offsets];
    this.#outside = null;
  }
}

/** Offsets [R - I | t] of all handles, by their motions seen from the first. */
function offsetsOf(relative: readonly Motion[]): number[] {
  return relative
    .flatMap(({ rotation, translation }) =>
      translation.flatMap((t, r) => [...[0, 1, 2].map((c) => rotation[3 * r + c] - Number(r === c)), t]),
    )
    .fill(0, 0, 12); // exactly
}

/** A handle's motion as it is seen from the first one. */
function relativeMotion(first: RigidMap, own: RigidMap, center: Vector): Motion {
  const back = transposed(first.rotation);
  const rotation = product(back, own.rotation);
  const shift = applied(back, minus(own.shift, first.shift));
  return { rotation, translation: minus(plus(applied(rotation, center), shift), center) };
}
