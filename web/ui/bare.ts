import type { Object3D } from "three";

import { Mesh } from "../render/index.ts";

/** Hides objects that are no surfaces, such as the dots of handles; the result shows them again. */
export function withoutMarks(root: Object3D): () => void {
  const marks: Object3D[] = [];
  root.traverse((part) => {
    const isMark = part instanceof Mesh && !("shownPositions" in part.material.uniforms);
    if (isMark && part.visible) marks.push(part);
  });
  for (const mark of marks) mark.visible = false;
  return () => marks.forEach((mark) => (mark.visible = true));
}
