import type { CoreExports } from "./core_exports.ts";
import { UnreadableModel } from "./errors.ts";
import type { BlendingModel, Cubature, PosingModel } from "./model.ts";

const NOT_DEFINITE = -3;

/** A session of the core, as a pointer. Throws UnreadableModel for a damaged model. */
export function createSession(exports: CoreExports, model: PosingModel | BlendingModel): number {
  const basis = exports.malloc(16); // snapspace_basis {int vertices, tau, modes}: coordinates only
  const error = exports.malloc(8);
  new Int32Array(exports.memory.buffer, basis, 4).fill(0);
  const session =
    model.kind === "posing"
      ? createPosing(exports, model, basis, error)
      : exports.snapspace_create_blending(
          model.dimension,
          model.poses.length,
          copied(exports, model.quartics), // read in place: stays
          basis,
          error,
        );
  const code = new Int32Array(exports.memory.buffer, error, 1)[0];
  if (session === 0)
    throw new UnreadableModel(
      code === NOT_DEFINITE
        ? "The model is damaged: its energy has no minimum at rest. Build it again."
        : `The model does not fit the page's core (error ${code}).`,
    );
  return session;
}

function createPosing(exports: CoreExports, model: PosingModel, basis: number, error: number): number {
  const { elastic } = model;
  const given = [model.K, model.L, model.S].map((array) => copied(exports, array));
  const [K, L, S] = given;
  const rest = [K, L, S, basis, error] as const;
  let session;
  if (elastic.kind === "quartic") {
    given.push(copied(exports, elastic.coefficients));
    session = exports.snapspace_create_posing(model.dimension, model.handles.length, given[3], ...rest);
  } else {
    given.push(...cubatureOf(exports, elastic, model.material));
    session = exports.snapspace_create_posing_cubature(
      model.dimension,
      model.handles.length,
      given[3],
      ...rest,
    );
  }
  given.forEach((array) => exports.free(array));
  return session;
}

/** A snapspace_cubature, its rows and its weights. */
function cubatureOf(exports: CoreExports, cubature: Cubature, material: PosingModel["material"]): number[] {
  const rows = copied(exports, cubature.rows);
  const weights = copied(exports, cubature.weights);
  // snapspace_cubature: tets and two pointers at 0, 4, 8, then doubles at 16, 24
  const all = exports.malloc(32);
  new Int32Array(exports.memory.buffer, all, 3).set([cubature.weights.length, rows, weights]);
  new Float64Array(exports.memory.buffer, all + 16, 2).set([material.lam, material.mu]);
  return [all, rows, weights];
}

function copied(exports: CoreExports, values: Float64Array | Float32Array): number {
  const pointer = exports.malloc(Math.max(values.byteLength, 8));
  if (pointer === 0) throw new UnreadableModel("The browser has not enough memory for this model.");
  const { buffer } = exports.memory;
  new Uint8Array(buffer, pointer, values.byteLength).set(
    new Uint8Array(values.buffer, values.byteOffset, values.byteLength),
  );
  return pointer;
}
