import { Box3 } from "three";

/** The box around points, x y z after each other. */
export function boxOf(points: Float32Array): Box3 {
  return new Box3().setFromArray(points);
}
