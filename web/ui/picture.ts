import { Color } from "three";

import { LostGraphics } from "../render/index.ts";
import type { Stage } from "./stage.ts";

/** Width and height in pixels. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

/** What is drawn behind the shape; null is transparent. */
export type Background = Color | null;

/** The colour behind the stage. */
export function paper(): Color {
  return new Color(getComputedStyle(document.body).backgroundColor);
}

/** Draws the stage at any size, and lets `take` read the canvas before the browser shows anything.
 *
 * Throws a RangeError for a size that the graphics cannot draw, and `LostGraphics`. */
export function drawAt<T>(
  stage: Stage,
  { width, height }: Size,
  background: Background,
  take: (canvas: HTMLCanvasElement) => T,
): T {
  const { renderer, camera, scene } = stage;
  const aspect = camera.aspect;
  if (renderer.graphics.isLost) throw new LostGraphics();
  try {
    renderer.setSize(width, height, 1);
    if (renderer.gl.drawingBufferWidth !== width || renderer.gl.drawingBufferHeight !== height)
      throw new RangeError(
        `This browser cannot draw ${width} x ${height} pixels; ask for a smaller picture.`,
      );
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    renderer.background = background;
    renderer.render(scene, camera);
    return take(renderer.canvas);
  } finally {
    renderer.background = null;
    camera.aspect = aspect;
    camera.updateProjectionMatrix();
    stage.fit();
    renderer.render(scene, camera); // at once: the browser may show the canvas before the next frame
  }
}

/** A PNG file of the stage. */
export function png(stage: Stage, size: Size, background: Background): Promise<Blob> {
  return drawAt(stage, size, background, (canvas) => {
    // the bitmap is copied now, only its encoding takes time
    return new Promise((resolve, reject) =>
      canvas.toBlob(
        (blob) => (blob ? resolve(blob) : reject(new RangeError("The picture is too large."))),
        "image/png",
      ),
    );
  });
}

/** The pixels of the stage, row by row from the top, four bytes each. */
export function pixels(stage: Stage, size: Size, background: Background): Uint8ClampedArray {
  return drawAt(stage, size, background, (canvas) => {
    const copy = new OffscreenCanvas(size.width, size.height).getContext("2d", { willReadFrequently: true })!;
    copy.drawImage(canvas, 0, 0);
    return copy.getImageData(0, 0, size.width, size.height).data;
  });
}
