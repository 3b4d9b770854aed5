import { createSession, valueScaleOf } from "./core_create.ts";
import { ERROR, METHOD, OPTIONS, REPORT, STATUS, type CoreExports } from "./core_exports.ts";
import { CoreMemory } from "./core_memory.ts";
import type { BlendingModel, PosingModel } from "./model.ts";

/** core/online as WebAssembly: the functions of core/online/snapspace_online.h on numbers of JavaScript. */

const STATUS_NAMES = {
  [STATUS.CONVERGED]: "converged",
  [STATUS.MAX_ITERATIONS]: "max_iterations",
  [STATUS.LINE_SEARCH_FAILED]: "line_search_failed",
  [STATUS.ENERGY_NOT_FINITE]: "not_finite",
  [STATUS.MAX_EVALUATIONS]: "max_evaluations",
} as const;
type Status = keyof typeof STATUS_NAMES;

/** How one frame was solved; as FrameReport of the Python package. */
export interface FrameReport {
  status: (typeof STATUS_NAMES)[Status] | "unbounded";
  iterations: number;
  evaluations: number;
  value: number;
  gradientNorm: number;
  milliseconds: number;
}

export interface Termination {
  tolerance: number;
  valueScale: number;
  coordinateScale: number;
  maxIterations: number;
  maxEvaluations: number;
}

/** One session of the core; its memory is its own WebAssembly instance, so that nothing leaks. */
export class Core {
  readonly #call: CoreExports;
  readonly #memory: CoreMemory;
  readonly #session: number;
  readonly #dimension: number;
  readonly #method: number;
  readonly #numbers: number; // scratch for arguments and results
  readonly #options: number;
  readonly #report: number;
  readonly #before: number;
  readonly #hasProbe: boolean;
  /** Unit of energy for the termination tests. */
  readonly valueScale: number;

  /** `module` is web/generated/core.wasm. Throws UnreadableModel for a damaged model, or an
   * unknown material. */
  static async create(module: WebAssembly.Module, model: PosingModel | BlendingModel): Promise<Core> {
    const instance = await WebAssembly.instantiate(module, {});
    return new Core(instance.exports as unknown as CoreExports, model);
  }

  private constructor(exports: CoreExports, model: PosingModel | BlendingModel) {
    exports._initialize();
    this.#call = exports;
    this.#dimension = model.dimension;
    this.#session = createSession(exports, model);
    this.valueScale = valueScaleOf(exports, model.valueScale);
    // a Hessian of a cubature costs d / 4 times its gradient, and so does one of stars
    const energy = model.kind === "posing" ? model.elastic : model.blends;
    this.#method = energy.kind === "cubature" || energy.kind === "stars" ? METHOD.BFGS : METHOD.NEWTON;
    const inputs = model.kind === "posing" ? 12 * model.handles.length : model.poses.length;
    this.#memory = new CoreMemory(exports);
    this.#numbers = this.#memory.take(8 * Math.max(inputs, model.dimension));
    this.#options = this.#memory.take(OPTIONS.size);
    this.#report = this.#memory.take(REPORT.size);
    this.#before = this.#memory.take(8);
    this.#hasProbe = model.estimator !== null;
  }

  get dimension(): number {
    return this.#call.snapspace_dimension(this.#session);
  }

  set dimension(dimension: number) {
    if (!Number.isInteger(dimension) || dimension < 1 || dimension > this.#dimension)
      throw new RangeError(`dimension ${dimension} is not between 1 and ${this.#dimension}, the model's`);
    this.#check(this.#call.snapspace_set_dimension(this.#session, dimension));
  }

  setOffsets(offsets: ArrayLike<number>): void {
    this.#check(this.#call.snapspace_set_offsets(this.#session, this.#given(offsets)));
  }

  setWeights(weights: ArrayLike<number>): void {
    this.#check(this.#call.snapspace_set_weights(this.#session, this.#given(weights)));
  }

  get q(): Float64Array {
    this.#check(this.#call.snapspace_get_q(this.#session, this.#numbers));
    return this.#memory.doubles(this.#numbers, this.dimension);
  }

  set q(q: ArrayLike<number>) {
    this.#check(this.#call.snapspace_set_q(this.#session, this.#given(q)));
  }

  /** The reduced objective at coordinates, for the present motions or weights. */
  value(q: ArrayLike<number>): number {
    this.#check(this.#call.snapspace_value(this.#session, this.#given(q), this.#report));
    return this.#memory.doubles(this.#report, 1)[0];
  }

  /** The full residual at sampled vertices, for the present shape and motions or weights; null for a model without
   * estimator. */
  residual(): number | null {
    if (!this.#hasProbe) return null;
    this.#check(this.#call.snapspace_residual(this.#session, this.#report));
    return this.#memory.doubles(this.#report, 1)[0];
  }

  /** Solves from the present coordinates. */
  solve(stop: Termination): FrameReport {
    this.#memory.write(OPTIONS, this.#options, { method: this.#method, ...stop });
    const begin = performance.now();
    this.#check(this.#call.snapspace_solve(this.#session, this.#options, this.#report));
    return this.#read(performance.now() - begin);
  }

  /** The smallest curvature at rest, or at the mean shape. */
  softest(): number {
    this.#check(this.#call.snapspace_softest(this.#session, this.#report));
    return this.#memory.doubles(this.#report, 1)[0];
  }

  /** A step in time from the present coordinates: `weight` is density / dt^2, and the target is where the body would
   * come to without forces. Also the objective before the step. */
  step(
    weight: number,
    target: ArrayLike<number>,
    stop: Termination,
  ): { report: FrameReport; before: number } {
    this.#memory.write(OPTIONS, this.#options, { method: this.#method, ...stop });
    const begin = performance.now();
    this.#check(
      this.#call.snapspace_step(
        this.#session,
        weight,
        this.#given(target),
        this.#options,
        this.#report,
        this.#before,
      ),
    );
    const milliseconds = performance.now() - begin;
    const [before] = this.#memory.doubles(this.#before, 1);
    return { report: this.#read(milliseconds), before };
  }

  #read(milliseconds: number): FrameReport {
    const { status, ...report } = this.#memory.read(REPORT, this.#report);
    return { ...report, status: STATUS_NAMES[status as Status], milliseconds };
  }

  #given(values: ArrayLike<number>): number {
    new Float64Array(this.#call.memory.buffer, this.#numbers, values.length).set(values);
    return this.#numbers;
  }

  #check(code: number): void {
    if (code < 0)
      throw new RangeError(
        code === ERROR.NOT_FINITE ? "a number is not finite" : `the core refused (error ${code})`,
      );
  }
}
