import { Geometry } from "./geometry.ts";

type Corner = readonly [number, number, number];

/** A flat quadrilateral through four corners, seen from the side from which they go around to the left. */
export function quad(...corners: readonly [Corner, Corner, Corner, Corner]): Geometry {
  const data = new Float32Array(corners.flat());
  return new Geometry({ position: { data, size: 3 } }, new Uint32Array([0, 1, 2, 0, 2, 3]));
}
