import { Matrix4, Quaternion } from "three";

import type { Motion } from "../engine/index.ts";

type Rotation = Motion["rotation"];

/** A rotation matrix, row by row, as a quaternion. */
export function quaternionOf(R: Rotation): Quaternion {
  const matrix = new Matrix4().set(R[0], R[1], R[2], 0, R[3], R[4], R[5], 0, R[6], R[7], R[8], 0, 0, 0, 0, 1);
  return new Quaternion().setFromRotationMatrix(matrix);
}

/** The rotation matrix of a quaternion, row by row. */
export function rotationOf(quaternion: Quaternion): Rotation {
  const e = new Matrix4().makeRotationFromQuaternion(quaternion).elements; // column by column
  return [e[0], e[4], e[8], e[1], e[5], e[9], e[2], e[6], e[10]];
}
