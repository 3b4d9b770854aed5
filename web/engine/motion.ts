/** Rigid motions x -> R x + t. Matrices are 9 numbers, row by row. */

export type Vector = readonly [number, number, number];
export type Rotation = readonly number[];

export interface RigidMap {
  readonly rotation: Rotation;
  readonly shift: Vector;
}

export const IDENTITY: RigidMap = { rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1], shift: [0, 0, 0] };

/** R = Rz(gamma) Ry(beta) Rx(alpha) of extrinsic Euler angles in radians. */
export function rotationOfEuler([alpha, beta, gamma]: Vector): Rotation {
  const [ca, sa, cb, sb, cg, sg] = [
    Math.cos(alpha),
    Math.sin(alpha),
    Math.cos(beta),
    Math.sin(beta),
    Math.cos(gamma),
    Math.sin(gamma),
  ];
  return [
    cg * cb,
    cg * sb * sa - sg * ca,
    cg * sb * ca + sg * sa,
    sg * cb,
    sg * sb * sa + cg * ca,
    sg * sb * ca - cg * sa,
    -sb,
    cb * sa,
    cb * ca,
  ];
}

/** The angles of a rotation with |beta| <= pi / 2; in gimbal lock alpha is zero. */
export function eulerOfRotation(R: Rotation): Vector {
  const level = Math.hypot(R[7], R[8]);
  const alpha = level <= 4 * Number.EPSILON ? 0 : Math.atan2(R[7], R[8]);
  const [s, c] = [Math.sin(alpha), Math.cos(alpha)];
  return [alpha, Math.atan2(-R[6], level), Math.atan2(s * R[2] - c * R[1], c * R[4] - s * R[5])];
}

export function applied(R: Rotation, [x, y, z]: Vector): Vector {
  return [R[0] * x + R[1] * y + R[2] * z, R[3] * x + R[4] * y + R[5] * z, R[6] * x + R[7] * y + R[8] * z];
}

export function transposed(R: Rotation): Rotation {
  return [R[0], R[3], R[6], R[1], R[4], R[7], R[2], R[5], R[8]];
}

export function product(A: Rotation, B: Rotation): Rotation {
  const entry = (row: number, column: number) =>
    A[row] * B[column] + A[row + 1] * B[column + 3] + A[row + 2] * B[column + 6];
  return [
    entry(0, 0),
    entry(0, 1),
    entry(0, 2),
    entry(3, 0),
    entry(3, 1),
    entry(3, 2),
    entry(6, 0),
    entry(6, 1),
    entry(6, 2),
  ];
}

/** A rigid map as a motion about a centre at rest. */
export function motionOfMap(
  { rotation, shift }: RigidMap,
  center: Vector,
): { rotation: Rotation; translation: Vector } {
  return { rotation, translation: minus(plus(applied(rotation, center), shift), center) };
}

/** Difference of two vectors. */
export function minus(a: Vector, b: Vector): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function plus(a: Vector, b: Vector): Vector {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}
