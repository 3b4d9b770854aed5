import { certainRange, type CertainRange } from "./certain_range.ts";
import { Certifier, type Certificate } from "./certificate.ts";
import { Core, type FrameReport, type Termination } from "./core.ts";
import type { BlendingModel } from "./model.ts";
import { IDENTITY } from "./motion.ts";
import { SampleValues } from "./sample_values.ts";
import { TimeSteps } from "./time_steps.ts";
import { weightEnds, type WeightEnds } from "./weight_ends.ts";

// A solution farther from the mean shape than this many coordinate scales is rejected.
const FARTHEST = 100;

/** Shapes between the poses of a reduced model: set weights, read q. As BlendingSession of the Python package. */
export class BlendingSession {
  readonly model: BlendingModel;
  readonly #core: Core;
  readonly #stop: Termination;
  readonly #certifier: Certifier | null;
  readonly #certain: CertainRange | null;
  /** Frequency and damping of `step`. */
  readonly time: TimeSteps;
  #weights: number[] = [];
  #samples: SampleValues | null = null;

  static async create(module: WebAssembly.Module, model: BlendingModel): Promise<BlendingSession> {
    return new BlendingSession(model, await Core.create(module, model));
  }

  private constructor(model: BlendingModel, core: Core) {
    this.model = model;
    this.#core = core;
    this.#certifier = Certifier.of(model, core);
    this.#certain = certainRange(model);
    this.time = new TimeSteps(core, null, model.dimension);
    const { valueScale } = core;
    const { coordinateScale } = model;
    this.#stop = { tolerance: 1e-9, valueScale, coordinateScale, maxIterations: 300, maxEvaluations: 500 };
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

  get weights(): readonly number[] {
    return this.#weights;
  }

  /** Sets weights that sum to one, and solves, from the present shape or from other coordinates. A blend without a
   * minimum leaves shape and weights as they were. */
  blend(weights: readonly number[], start?: ArrayLike<number>): FrameReport {
    this.#check(weights);
    const before = this.#weights;
    const shape = this.q;
    this.#set(weights);
    if (start) this.#core.q = start;
    const report = this.#solveFrom(start ? null : before);
    if (Math.hypot(...this.q) > FARTHEST * this.model.coordinateScale) report.status = "unbounded";
    if (report.status === "unbounded" || report.status === "not_finite") {
      this.#set(before);
      this.#core.q = shape;
    }
    return report;
  }

  /** Coordinates of the shapes for weights; the present shape stays. */
  shapesAt(states: readonly (readonly number[])[]): Float64Array[] {
    const [weights, q] = [this.#weights, this.q];
    const found = states.map((state) => {
      this.blend(state);
      return this.q;
    });
    this.#set(weights);
    this.#core.q = q;
    return found;
  }

  /** Advances time by dt seconds, in which the weights become these: the shape swings after them. */
  step(dt: number, weights: readonly number[] = this.#weights): FrameReport {
    this.#check(weights);
    const [before, last] = [this.#weights, this.time.moving(IDENTITY)];
    this.#set(weights);
    const report = this.time.advance(last, IDENTITY, dt, this.#stop);
    if (report.status === "not_finite") this.#set(before);
    return report;
  }

  /** Speed of the coordinates in units of `coordinateScale`, per second; zero unless the last frame was a step. */
  get speed(): number {
    return this.time.speed(IDENTITY) / this.model.coordinateScale;
  }

  /** Solves for the present weights, from the present shape. */
  solve(): FrameReport {
    this.time.stop();
    return this.#core.solve(this.#stop);
  }

  /** How far the shape is from the full solution; null if the model has no estimate, or if the shape swings. */
  certificate(): Certificate | null {
    return this.speed > 0 ? null : (this.#certifier?.certify() ?? null);
  }

  /** Back to the mean shape: equal weights. */
  reset(): void {
    const count = this.model.poses.length;
    this.#set(Array<number>(count).fill(1 / count));
    this.#core.q = new Float64Array(this.dimension);
  }

  /** Poses whose weights are below the smallest one that was sampled. */
  get outside(): string[] {
    return this.model.poses.filter((_, pose) => this.#weights[pose] < this.model.lowestWeight - 1e-9);
  }

  /** Whether the energy certainly has a minimum for the present weights; null where no test is known. */
  get certain(): boolean | null {
    if (this.#certain) return this.#certain.holds(this.#weights);
    return this.#weights.every((w) => w >= 0) || null;
  }

  /** The smallest and the largest weight of one of some poses, see `weightEnds`. Many coordinates take milliseconds. */
  ends(poses: readonly number[], pose: number): WeightEnds {
    return weightEnds(this.model, this.#certain, poses, pose);
  }

  #check(weights: readonly number[]): void {
    const total = weights.reduce((sum, w) => sum + w, 0);
    if (weights.length !== this.model.poses.length || !(Math.abs(total - 1) <= 1e-9))
      throw new RangeError(`${this.model.poses.length} poses need as many weights, and a sum of one`);
  }

  #set(weights: readonly number[]): void {
    this.#core.setWeights(weights);
    this.#weights = [...weights];
  }

  /** Solves from the present shape or from the nearest training sample. A jump, to weights that are nearer to that
   * sample than to those before, starts where the energy is lower. A drag that ends above the sample is solved again
   * from there. */
  #solveFrom(before: readonly number[] | null): FrameReport {
    const [nearest, away] = this.#nearestSample();
    if (nearest < 0) return this.solve();
    const samples = this.#sampleValues();
    let milliseconds = 0;
    if (!before || away < squaredDistance(before, 0, this.#weights)) {
      if (this.#core.value(this.q) <= this.#core.value(samples.coordinates(nearest))) return this.solve();
    } else {
      const report = this.solve();
      const margin = this.#stop.tolerance * (this.#stop.valueScale + Math.abs(report.value));
      if (report.value - margin <= samples.at(nearest, this.#weights)) return report;
      milliseconds = report.milliseconds;
    }
    this.#core.q = samples.coordinates(nearest);
    const report = this.solve();
    return { ...report, milliseconds: milliseconds + report.milliseconds };
  }

  /** The sample with the nearest weights, and its squared distance; -1 if there are no samples. */
  #nearestSample(): [number, number] {
    const { sampleWeights, poses } = this.model;
    let [nearest, least] = [-1, Infinity];
    for (let sample = 0; sample * poses.length < sampleWeights.length; sample++) {
      const away = squaredDistance(sampleWeights, sample * poses.length, this.#weights);
      if (away < least) [nearest, least] = [sample, away];
    }
    return [nearest, least];
  }

  #sampleValues(): SampleValues {
    if (this.#samples?.dimension !== this.dimension) this.#samples = new SampleValues(this.#core, this.model);
    return this.#samples;
  }
}

function squaredDistance(from: ArrayLike<number>, first: number, to: readonly number[]): number {
  return to.reduce((sum, x, i) => sum + (from[first + i] - x) ** 2, 0);
}
