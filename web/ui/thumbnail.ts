import type { Stage } from "./stage.ts";
import type { Surface } from "./surface.ts";

const PIXELS = 96;

/** A small picture of a pose as a data address, drawn on a corner of the stage's own canvas.
 *
 * `poses` is shown alone; the caller draws the stage again before the browser shows it. */
export function thumbnail(stage: Stage, poses: Surface, hidden: Surface, weights: readonly number[]): string {
  const { renderer, camera, scene } = stage;
  const ratio = renderer.getPixelRatio();
  const copy = document.createElement("canvas");
  copy.width = copy.height = PIXELS;
  const before = { visible: poses.object.visible, background: hidden.object.visible };
  [poses.object.visible, hidden.object.visible, poses.shadowed] = [true, false, false];
  const place = poses.object.matrix.clone();
  poses.object.matrix.identity();
  poses.object.updateMatrixWorld(true);
  renderer.shadowMap.autoUpdate = false;
  poses.show(weights);
  stage.lookAt(poses.positions());
  renderer.setViewport(0, 0, PIXELS / ratio, PIXELS / ratio);
  renderer.render(scene, camera);
  // viewports count from the bottom, pictures from the top
  const top = renderer.domElement.height - PIXELS;
  copy.getContext("2d")!.drawImage(renderer.domElement, 0, top, PIXELS, PIXELS, 0, 0, PIXELS, PIXELS);
  renderer.setViewport(0, 0, renderer.domElement.width / ratio, renderer.domElement.height / ratio);
  renderer.shadowMap.autoUpdate = true;
  poses.object.matrix.copy(place);
  poses.object.matrixWorldNeedsUpdate = true;
  [poses.object.visible, hidden.object.visible, poses.shadowed] = [before.visible, before.background, true];
  stage.lookBack();
  return copy.toDataURL();
}
