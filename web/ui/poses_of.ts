import { reconstruct, type BlendingModel } from "../engine/index.ts";

/** The poses' surfaces: a blend's strain is the mean of those relative to each, with its weights. */
export function posesOf({ poses, poseSpace }: BlendingModel): Float32Array[] {
  return poses.map((_, pose) => {
    const shape = new Float32Array(poseSpace.base.length);
    reconstruct(
      poseSpace,
      poses.map((_, k) => (k === pose ? 1 : 0)),
      shape,
    );
    return shape;
  });
}
