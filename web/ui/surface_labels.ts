import { Vector3 } from "three";

import type { Stage } from "./stage.ts";
import type { Surface } from "./surface.ts";

/** Puts names below the surfaces that they belong to, or hides them. */
export function label(stage: Stage, names: HTMLElement[], surfaces: Surface[], visible: boolean): void {
  const { clientWidth, clientHeight } = stage.renderer.canvas;
  names.forEach((name, i) => {
    name.hidden = !visible;
    if (!visible) return;
    const foot = new Vector3().setFromMatrixPosition(surfaces[i].object.matrixWorld);
    const middle = new Vector3(...middleOf(surfaces[i].space.base)).applyMatrix4(
      surfaces[i].object.matrixWorld,
    );
    foot.set(middle.x, 0, middle.z).project(stage.camera);
    name.style.left = `${((foot.x + 1) / 2) * clientWidth}px`;
    name.style.top = `${((1 - foot.y) / 2) * clientHeight + 26}px`;
  });
}

function middleOf(shape: Float32Array): [number, number, number] {
  const sum = [0, 0, 0];
  for (let i = 0; i < shape.length; i++) sum[i % 3] += shape[i];
  const count = shape.length / 3;
  return [sum[0] / count, sum[1] / count, sum[2] / count];
}
