import { Color, Group } from "three";

import { Dot, flat, Geometry, Mesh } from "../render/index.ts";
import { handleColor } from "./handle_colors.ts";
import type { Posing } from "./posing.ts";

const BOX_OPACITY = 0.8;

/** A dot at every handle, and the sampled box of each handle that has left it. */
export class Marks {
  readonly #posing: Posing;
  readonly #dots: Dot[];
  readonly #boxes = new Map<number, Mesh>();
  readonly #group = new Group();

  constructor(posing: Posing) {
    this.#posing = posing;
    const { handles, boxes } = posing.session.model;
    this.#dots = handles.map((_, handle) => new Dot(new Color(handleColor(handle))));
    handles.forEach(({ center }, handle) => {
      const [x, y, z] = boxes[handle].translation;
      if (handle === 0 || !(x > 0 || y > 0 || z > 0)) return;
      const color = new Color(handleColor(handle));
      const lines = new Mesh(boxEdges(x, y, z), flat(color, BOX_OPACITY, { drawsLines: true }));
      lines.position.set(...center);
      this.#boxes.set(handle, lines);
      posing.surface.object.add(lines); // the box is relative to the first handle
    });
    this.#group.add(...this.#dots);
    posing.stage.root.add(this.#group);
    this.update();
  }

  update(): void {
    const { session, selected } = this.#posing;
    this.#dots.forEach((dot, handle) => {
      const [x, y, z] = session.place(handle);
      dot.position.set(x, y, z);
      dot.scale.setScalar((handle === selected ? 0.034 : 0.026) * session.model.diagonal);
    });
    this.#boxes.forEach((lines) => (lines.visible = false));
    for (const { handle } of session.outside) {
      const lines = this.#boxes.get(handle);
      if (lines) lines.visible = true;
    }
  }

  dispose(): void {
    this.#group.removeFromParent();
    this.#boxes.forEach((lines) => {
      lines.removeFromParent();
      lines.geometry.dispose();
    });
    this.#dots.forEach((dot) => dot.geometry.dispose());
  }
}

/** The twelve edges of a box around the origin, from half its sides. */
function boxEdges(x: number, y: number, z: number): Geometry {
  const corners = Array.from({ length: 8 }, (_, k) => [k & 1 ? x : -x, k & 2 ? y : -y, k & 4 ? z : -z]);
  const edges = corners.flatMap((_, k) =>
    [1, 2, 4].filter((bit) => !(k & bit)).flatMap((bit) => [k, k | bit]),
  );
  return new Geometry(
    { position: { data: new Float32Array(corners.flat()), size: 3 } },
    new Uint32Array(edges),
  );
}
