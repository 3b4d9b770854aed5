import {
  BoxGeometry,
  CanvasTexture,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Sprite,
  SpriteMaterial,
  SRGBColorSpace,
} from "three";

import { handleColor } from "./handle_colors.ts";
import type { Posing } from "./posing.ts";

/** A dot at every handle, and the sampled box of each handle that has left it. */
export class Marks {
  readonly #posing: Posing;
  readonly #dots: Sprite[];
  readonly #boxes = new Map<number, LineSegments>();
  readonly #group = new Group();

  constructor(posing: Posing) {
    this.#posing = posing;
    const { handles, boxes } = posing.session.model;
    this.#dots = handles.map((_, handle) => dot(handleColor(handle)));
    handles.forEach(({ center }, handle) => {
      const [x, y, z] = boxes[handle].translation;
      if (handle === 0 || !(x > 0 || y > 0 || z > 0)) return;
      const edges = new EdgesGeometry(new BoxGeometry(2 * x, 2 * y, 2 * z));
      const lines = new LineSegments(
        edges,
        new LineBasicMaterial({ color: handleColor(handle), transparent: true, opacity: 0.8 }),
      );
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
    this.#dots.forEach((sprite, handle) => {
      const [x, y, z] = session.place(handle);
      sprite.position.set(x, y, z);
      sprite.scale.setScalar((handle === selected ? 0.034 : 0.026) * session.model.diagonal);
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
    this.#dots.forEach((sprite) => sprite.material.map?.dispose());
  }
}

function dot(color: string): Sprite {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext("2d")!;
  const disc = (radius: number, fill: string) => {
    pen.beginPath();
    pen.arc(32, 32, radius, 0, 2 * Math.PI);
    pen.fillStyle = fill;
    pen.fill();
  };
  disc(30, "rgba(20, 24, 32, 0.28)");
  disc(27, "#ffffff");
  disc(20, color);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  const sprite = new Sprite(
    new SpriteMaterial({ map, depthTest: false, toneMapped: false, transparent: true }),
  );
  sprite.renderOrder = 5;
  return sprite;
}
