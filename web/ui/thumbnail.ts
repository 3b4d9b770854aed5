import type { Stage } from "./stage.ts";
import type { Surface } from "./surface.ts";

const PIXELS = 96;

/** A small picture of a pose as a data address, drawn on a corner of the stage's own canvas.
 *
 * `poses` is shown alone; the caller draws the stage again before the browser shows it. */
export function thumbnail(stage: Stage, poses: Surface, hidden: Surface, weights: readonly number[]): string {
  const { renderer, camera, scene } = stage;
  const copy = document.createElement("canvas");
  copy.width = copy.height = PIXELS;
  const before = { visible: poses.object.visible, background: hidden.object.visible };
  [poses.object.visible, hidden.object.visible, poses.shadowed] = [true, false, false];
  const place = poses.object.matrix.clone();
  poses.object.matrix.identity();
  poses.object.updateMatrixWorld(true);
  poses.show(weights);
  stage.lookAt(poses.positions());
  renderer.renderCorner(scene, camera, PIXELS);
  // the lower left corner: pictures count from the top
  const top = renderer.canvas.height - PIXELS;
  copy.getContext("2d")!.drawImage(renderer.canvas, 0, top, PIXELS, PIXELS, 0, 0, PIXELS, PIXELS);
  poses.object.matrix.copy(place);
  poses.object.matrixWorldNeedsUpdate = true;
  [poses.object.visible, hidden.object.visible, poses.shadowed] = [before.visible, before.background, true];
  stage.lookBack();
  return copy.toDataURL();
}
