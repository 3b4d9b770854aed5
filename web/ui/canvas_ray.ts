import { Ray, Vector3, type Camera } from "three";

import type { Stage } from "./stage.ts";

/** A point of the window in the canvas's coordinates, from -1 to 1 to the right and up. */
export function onCanvas(canvas: HTMLCanvasElement, x: number, y: number): [number, number] {
  const box = canvas.getBoundingClientRect();
  return [(2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height];
}

/** Where a point of the stage is in the window. */
export function inWindow({ renderer, camera }: Stage, place: Vector3): [number, number] {
  const box = renderer.canvas.getBoundingClientRect();
  const { x, y } = place.clone().project(camera);
  return [box.left + ((x + 1) / 2) * box.width, box.top + ((1 - y) / 2) * box.height];
}

/** The ray from the camera through a point in the canvas's coordinates. */
export function rayThrough(camera: Camera, [x, y]: readonly [number, number]): Ray {
  const origin = new Vector3().setFromMatrixPosition(camera.matrixWorld);
  const direction = new Vector3(x, y, 0.5).unproject(camera).sub(origin).normalize();
  return new Ray(origin, direction);
}

/** The ray through a point of the window. */
export function rayAt({ renderer, camera }: Stage, x: number, y: number): Ray {
  return rayThrough(camera, onCanvas(renderer.canvas, x, y));
}
