import { Core, type FrameReport, type Termination } from "./core.ts";
import type { PosingModel } from "./model.ts";
import { applied, minus, plus, transposed, type RigidMap, type Vector } from "./motion.ts";

/** A point of the surface, inside a triangle, that is pulled to a place. */
export interface PulledPoint {
  readonly corners: readonly number[];
  /** Shares of the corners, whose sum is one. */
  readonly shares: readonly number[];
  readonly target: Vector;
}

/** A pull is as stiff as this many handles of the model. */
const STIFFNESS = 1;

/** Points of the surface as soft handles of a reduced model, at once: nothing is sampled or trained.
 *
 * A pull adds w |x_p(q) - target|^2 to the objective, and x_p = tau_p + U_p q needs three rows of the basis. To the core
 * each point is one more handle, which takes translations only. */
export class Pulls {
  readonly #core: Core;
  readonly #rests: readonly Vector[];
  readonly #stop: Termination;
  readonly #corners: readonly PulledPoint[];
  #targets: Vector[];

  static async create(
    module: WebAssembly.Module,
    model: PosingModel,
    points: readonly PulledPoint[],
    stop: Termination,
  ): Promise<Pulls> {
    return new Pulls(await Core.create(module, withPoints(model, points)), model, points, stop);
  }

  private constructor(core: Core, model: PosingModel, points: readonly PulledPoint[], stop: Termination) {
    [this.#core, this.#corners, this.#stop] = [core, points, stop];
    this.#rests = points.map((point) => restOf(model, point));
    this.#targets = points.map(({ target }) => target);
  }

  /** The points with their present targets. */
  get points(): PulledPoint[] {
    return this.#corners.map((point, k) => ({ ...point, target: this.#targets[k] }));
  }

  /** Moves the last point's target. */
  set target(target: Vector) {
    this.#targets = [...this.#targets.slice(0, -1), target];
  }

  get q(): Float64Array {
    return this.#core.q;
  }

  set q(q: ArrayLike<number>) {
    if (q.length !== this.#core.dimension) this.#core.dimension = q.length;
    this.#core.q = q;
  }

  /** Solves with the offsets of the model's own handles, seen from the first one, which is carried by a rigid map. */
  solve(offsets: readonly number[], carriedBy: RigidMap): FrameReport {
    const all = [...offsets];
    const back = transposed(carriedBy.rotation);
    this.#targets.forEach((target, k) => {
      const [x, y, z] = minus(applied(back, minus(target, carriedBy.shift)), this.#rests[k]);
      all.push(0, 0, 0, x, 0, 0, 0, y, 0, 0, 0, z);
    });
    this.#core.setOffsets(all);
    return this.#core.solve(this.#stop);
  }
}

/** Where a point is for coordinates, carried by a rigid map. */
export function placeOf(model: PosingModel, point: PulledPoint, q: ArrayLike<number>, map: RigidMap): Vector {
  const rows = rowsOf(model, point);
  const rest = restOf(model, point);
  const place = [0, 1, 2].map((axis) => {
    let x = rest[axis];
    for (let i = 0; i < q.length; i++) x += rows[axis][i] * q[i];
    return x;
  });
  return plus(applied(map.rotation, [place[0], place[1], place[2]]), map.shift);
}

/** Where a point is pulled to from rest, as seen from the first handle, which is carried by a rigid map. */
export function reachOf(model: PosingModel, point: PulledPoint, { rotation, shift }: RigidMap): Vector {
  return minus(applied(transposed(rotation), minus(point.target, shift)), restOf(model, point));
}

/** The model with points as further handles. */
function withPoints(model: PosingModel, points: readonly PulledPoint[]): PosingModel {
  const { dimension: d, handles } = model;
  const K = Float64Array.from(model.K);
  const L = new Float64Array(model.L.length + points.length * d * 12);
  const S = new Float64Array(model.S.length + points.length * 16);
  L.set(model.L);
  S.set(model.S);
  let stiffness = 0;
  handles.forEach((_, handle) => (stiffness = Math.max(stiffness, STIFFNESS * model.S[16 * handle + 15])));
  points.forEach((point, k) => {
    const rows = rowsOf(model, point);
    const [ownL, ownS] = [model.L.length + k * d * 12, model.S.length + k * 16];
    for (let i = 0; i < d; i++) {
      for (let j = 0; j < d; j++)
        for (let axis = 0; axis < 3; axis++) K[i * d + j] += stiffness * rows[axis][i] * rows[axis][j];
      for (let axis = 0; axis < 3; axis++) L[ownL + 12 * i + 4 * axis + 3] = stiffness * rows[axis][i];
    }
    S[ownS + 15] = stiffness;
  });
  const more = points.map((point, k) => ({ name: `pull ${k}`, center: restOf(model, point) }));
  return { ...model, K, L, S, handles: [...handles, ...more], estimator: null };
}

function rowsOf({ dimension, space }: PosingModel, { corners, shares }: PulledPoint): number[][] {
  const { modes, scales, base } = space;
  return [0, 1, 2].map((axis) =>
    Array.from({ length: dimension }, (_, mode) =>
      corners.reduce(
        (sum, vertex, c) => sum + shares[c] * scales[mode] * modes[mode * base.length + 3 * vertex + axis],
        0,
      ),
    ),
  );
}

function restOf({ space }: PosingModel, { corners, shares }: PulledPoint): Vector {
  const at = (axis: number) =>
    corners.reduce((sum, vertex, c) => sum + shares[c] * space.base[3 * vertex + axis], 0);
  return [at(0), at(1), at(2)];
}
