import type { RigidMap } from "./motion.ts";
import { applied, minus, product, transposed } from "./motion.ts";

/** Pairs of coordinates, x x, x y, x z, y y, y z, z z. */
const PAIRS = [
  [0, 0],
  [0, 1],
  [0, 2],
  [1, 1],
  [1, 2],
  [2, 2],
] as const;

/** Products of the modes by coordinates, as RigidFrames of the Python package. */
export interface RigidFrames {
  /** U_a^T M U_b of the pairs, 6 x dimension x dimension. */
  readonly modes: Float32Array;
  /** U_a^T M tau_b, 3 x 3 x dimension. */
  readonly tau: Float64Array;
  /** U_a^T M 1, 3 x dimension. */
  readonly ones: Float64Array;
}

/** Coordinates of a shape of the frame `old`, projected to the subspace in the frame `now`: q has the leading ones of
 * `dimension`. Without products they are q: the body is carried along. */
export function seenFrom(
  frames: RigidFrames | null,
  dimension: number,
  q: Float64Array,
  old: RigidMap,
  now: RigidMap,
): Float64Array {
  if (!frames || isSame(old, now)) return q;
  const back = transposed(now.rotation);
  const R = product(back, old.rotation);
  const t = applied(back, minus(old.shift, now.shift));
  const moved = new Float64Array(q.length);
  for (let i = 0; i < q.length; i++) {
    for (let a = 0; a < 3; a++) {
      moved[i] += t[a] * frames.ones[a * dimension + i];
      for (let b = 0; b < 3; b++)
        moved[i] += (R[3 * a + b] - (a === b ? 1 : 0)) * frames.tau[(3 * a + b) * dimension + i];
    }
  }
  PAIRS.forEach(([a, b], pair) => {
    const [forth, back] = [R[3 * a + b], a === b ? 0 : R[3 * b + a]];
    for (let i = 0; i < q.length; i++) {
      const row = (pair * dimension + i) * dimension;
      for (let j = 0; j < q.length; j++) {
        const entry = frames.modes[row + j];
        moved[i] += forth * entry * q[j];
        moved[j] += back * entry * q[i];
      }
    }
  });
  return moved;
}

export function isSame(a: RigidMap, b: RigidMap): boolean {
  return (
    a === b || (a.rotation.every((x, i) => x === b.rotation[i]) && a.shift.every((x, i) => x === b.shift[i]))
  );
}
