import { createSession } from "./core_create.ts";
import type { CoreExports } from "./core_exports.ts";
import type { BlendingModel, PosingModel } from "./model.ts";

/** core/online as WebAssembly: the functions of core/online/snapspace_online.h on numbers of JavaScript. */

const STATUS = [
  "converged",
  "max_iterations",
  "line_search_failed",
  "not_finite",
  "max_evaluations",
] as const;
const [NEWTON, BFGS] = [0, 1];

/** How one frame was solved; as FrameReport of the Python package. */
export interface FrameReport {
  status: (typeof STATUS)[number] | "unbounded";
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
  readonly #session: number;
  readonly #dimension: number;
  readonly #method: number;
  readonly #numbers: number; // scratch for arguments and results
  readonly #options: number;
  readonly #report: number;

  /** `module` is web/generated/core.wasm. Throws UnreadableModel for a damaged model. */
  static async create(module: WebAssembly.Module, model: PosingModel | BlendingModel): Promise<Core> {
    const instance = await WebAssembly.instantiate(module, {});
    return new Core(instance.exports as unknown as CoreExports, model);
  }

  private constructor(exports: CoreExports, model: PosingModel | BlendingModel) {
    exports._initialize();
    this.#call = exports;
    this.#dimension = model.dimension;
    this.#session = createSession(exports, model);
    // a Hessian of a cubature costs d / 4 times its gradient
    this.#method = model.kind === "posing" && model.elastic.kind === "cubature" ? BFGS : NEWTON;
    const inputs = model.kind === "posing" ? 12 * model.handles.length : model.poses.length;
    this.#numbers = exports.malloc(8 * Math.max(inputs, model.dimension));
    this.#options = exports.malloc(40);
    this.#report = exports.malloc(32);
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
    return new Float64Array(this.#call.memory.buffer, this.#numbers, this.dimension).slice();
  }

  set q(q: ArrayLike<number>) {
    this.#check(this.#call.snapspace_set_q(this.#session, this.#given(q)));
  }

  /** The reduced objective at coordinates, for what is set. */
  value(q: ArrayLike<number>): number {
    this.#check(this.#call.snapspace_value(this.#session, this.#given(q), this.#report));
    return new Float64Array(this.#call.memory.buffer, this.#report, 1)[0];
  }

  /** Solves from the present coordinates. */
  solve(stop: Termination): FrameReport {
    const { buffer } = this.#call.memory;
    // snapspace_options: method, then doubles at 8, 16, 24, then ints at 32, 36
    new Int32Array(buffer, this.#options, 10).fill(0)[0] = this.#method;
    new Float64Array(buffer, this.#options + 8, 3).set([
      stop.tolerance,
      stop.valueScale,
      stop.coordinateScale,
    ]);
    new Int32Array(buffer, this.#options + 32, 2).set([stop.maxIterations, stop.maxEvaluations]);
    const begin = performance.now();
    this.#check(this.#call.snapspace_solve(this.#session, this.#options, this.#report));
    const milliseconds = performance.now() - begin;
    // snapspace_report: status, iterations, evaluations at 0, 4, 8, then doubles at 16, 24
    const [status, iterations, evaluations] = new Int32Array(buffer, this.#report, 3);
    const [value, gradientNorm] = new Float64Array(buffer, this.#report + 16, 2);
    return { status: STATUS[status], iterations, evaluations, value, gradientNorm, milliseconds };
  }

  #given(values: ArrayLike<number>): number {
    new Float64Array(this.#call.memory.buffer, this.#numbers, values.length).set(values);
    return this.#numbers;
  }

  #check(code: number): void {
    if (code < 0)
      throw new RangeError(code === -2 ? "a number is not finite" : `the core refused (error ${code})`);
  }
}
