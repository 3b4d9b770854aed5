import { Ray, Vector3, type Camera } from "three";

import type { Stage } from "./stage.ts";

type Pixel = [x: number, y: number];

/** Where a point of the stage is in the window. */
export function inWindow(stage: Stage, place: Vector3): Pixel {
  return allInWindow(stage, [place])[0];
}

/** Where points of the stage are in the window, whose layout is asked for once. */
export function allInWindow({ renderer, camera }: Stage, places: readonly Vector3[]): Pixel[] {
  const box = renderer.canvas.getBoundingClientRect();
  return places.map((place) => {
    const { x, y } = place.clone().project(camera);
    return [box.left + ((x + 1) / 2) * box.width, box.top + ((1 - y) / 2) * box.height];
  });
}

/** The ray from the camera through a point of the canvas, from -1 to 1 to the right and up. */
export function rayThrough(camera: Camera, [x, y]: readonly [number, number]): Ray {
  const origin = new Vector3().setFromMatrixPosition(camera.matrixWorld);
  const direction = new Vector3(x, y, 0.5).unproject(camera).sub(origin).normalize();
  return new Ray(origin, direction);
}

/** The ray through a point of the window. */
export function rayAt({ renderer, camera }: Stage, x: number, y: number): Ray {
  const box = renderer.canvas.getBoundingClientRect();
  return rayThrough(camera, [(2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height]);
}
