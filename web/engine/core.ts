import { UnreadableModel } from "./errors.ts";
import type { BlendingModel, PosingModel } from "./model.ts";

/** core/online as WebAssembly: the functions of core/online/snapspace_online.h on numbers of JavaScript. */

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  malloc(bytes: number): number;
  free(pointer: number): void;
  snapspace_create_posing(
    dimension: number,
    handles: number,
    quartic: number,
    K: number,
    L: number,
    S: number,
    basis: number,
    error: number,
  ): number;
  snapspace_create_blending(
    dimension: number,
    poses: number,
    quartics: number,
    basis: number,
    error: number,
  ): number;
  snapspace_destroy(session: number): void;
  snapspace_set_offsets(session: number, offsets: number): number;
  snapspace_set_weights(session: number, weights: number): number;
  snapspace_set_dimension(session: number, dimension: number): number;
  snapspace_dimension(session: number): number;
  snapspace_solve(session: number, options: number, report: number): number;
  snapspace_value(session: number, q: number, value: number): number;
  snapspace_get_q(session: number, q: number): number;
  snapspace_set_q(session: number, q: number): number;
}

const STATUS = [
  "converged",
  "max_iterations",
  "line_search_failed",
  "not_finite",
  "max_evaluations",
] as const;
const NOT_DEFINITE = -3;

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
  readonly #call: Exports;
  readonly #session: number;
  readonly #dimension: number;
  readonly #numbers: number; // scratch for arguments and results
  readonly #options: number;
  readonly #report: number;

  /** `module` is web/generated/core.wasm. Throws UnreadableModel for a damaged model. */
  static async create(module: WebAssembly.Module, model: PosingModel | BlendingModel): Promise<Core> {
    const instance = await WebAssembly.instantiate(module, {});
    return new Core(instance.exports as unknown as Exports, model);
  }

  private constructor(exports: Exports, model: PosingModel | BlendingModel) {
    this.#call = exports;
    this.#dimension = model.dimension;
    exports._initialize();
    const basis = exports.malloc(16); // snapspace_basis {int vertices, tau, modes}: coordinates only
    const error = exports.malloc(8);
    new Int32Array(exports.memory.buffer, basis, 4).fill(0);
    let inputs = 12 * (model.kind === "posing" ? model.handles.length : 0);
    if (model.kind === "posing") {
      const arrays = [model.quartic, model.K, model.L, model.S].map((array) => this.#copied(array));
      const [quartic, K, L, S] = arrays;
      this.#session = exports.snapspace_create_posing(
        model.dimension,
        model.handles.length,
        quartic,
        K,
        L,
        S,
        basis,
        error,
      );
      arrays.forEach((array) => exports.free(array));
    } else {
      inputs = model.poses.length;
      const quartics = this.#copied(model.quartics); // read in place: stays
      this.#session = exports.snapspace_create_blending(
        model.dimension,
        model.poses.length,
        quartics,
        basis,
        error,
      );
    }
    const code = new Int32Array(exports.memory.buffer, error, 1)[0];
    if (this.#session === 0)
      throw new UnreadableModel(
        code === NOT_DEFINITE
          ? "The model is damaged: its energy has no minimum at rest. Build it again."
          : `The model does not fit the page's core (error ${code}).`,
      );
    this.#numbers = exports.malloc(8 * Math.max(inputs, model.dimension, 1));
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
    // snapspace_options: method (0, Newton), then doubles at 8, 16, 24, then ints at 32, 36
    new Int32Array(buffer, this.#options, 10).fill(0);
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

  #copied(values: Float64Array): number {
    const pointer = this.#call.malloc(8 * Math.max(values.length, 1));
    if (pointer === 0) throw new UnreadableModel("The browser has not enough memory for this model.");
    new Float64Array(this.#call.memory.buffer, pointer, values.length).set(values);
    return pointer;
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
