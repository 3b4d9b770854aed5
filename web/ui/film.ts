import { applyPalette, GIFEncoder, quantize } from "gifenc";
import { Vector3 } from "three";

import { paper, pixels, type Size } from "./picture.ts";
import type { Stage } from "./stage.ts";

/** Frames a second of a GIF; browsers show delays in hundredths of a second. */
const GIF_RATE = 20;
const COLORS = 256;
const UP = new Vector3(0, 1, 0);

/** A film that is being recorded from the canvas, as WebM. */
export class Recording {
  readonly #recorder: MediaRecorder;
  readonly #parts: Blob[] = [];

  /** Whether this browser can record. */
  static get isPossible(): boolean {
    return typeof MediaRecorder !== "undefined" && MediaRecorder.isTypeSupported("video/webm");
  }

  constructor(canvas: HTMLCanvasElement) {
    this.#recorder = new MediaRecorder(canvas.captureStream(), {
      mimeType: "video/webm",
      videoBitsPerSecond: 12_000_000,
    });
    this.#recorder.addEventListener("dataavailable", ({ data }) => this.#parts.push(data));
    this.#recorder.start();
  }

  /** Ends the film. */
  stop(): Promise<Blob> {
    return new Promise((resolve) => {
      this.#recorder.addEventListener("stop", () => resolve(new Blob(this.#parts, { type: "video/webm" })));
      this.#recorder.stop();
    });
  }
}

/** Shows the stage from all around; the camera ends where it began. `show` gets shares of the circle from 0 to 1. */
async function turn(stage: Stage, run: (show: (share: number) => void) => Promise<void>): Promise<void> {
  const { camera, controls } = stage;
  const [place, target] = [camera.position.clone(), controls.target.clone()];
  const show = (share: number) => {
    const away = place
      .clone()
      .sub(target)
      .applyAxisAngle(UP, 2 * Math.PI * share);
    camera.position.copy(target).add(away);
    camera.lookAt(target);
    camera.updateMatrixWorld();
  };
  controls.enabled = false;
  try {
    await run(show);
  } finally {
    show(0);
    controls.enabled = true;
    controls.update();
    stage.draw();
  }
}

/** A turntable as WebM, in real time. */
export async function webmTurntable(stage: Stage, seconds: number, signal: AbortSignal): Promise<Blob> {
  const recording = new Recording(stage.renderer.canvas);
  await turn(stage, async (show) => {
    const begin = performance.now();
    for (let share = 0; share < 1 && !signal.aborted;) {
      const now = await nextFrame();
      share = Math.max(0, (now - begin) / (1000 * seconds));
      show(Math.min(share, 1));
      stage.draw();
    }
  });
  return recording.stop();
}

/** A turntable as GIF; `progress` gets shares from 0 to 1. */
export async function gifTurntable(
  stage: Stage,
  size: Size,
  seconds: number,
  signal: AbortSignal,
  progress: (share: number) => void,
): Promise<Uint8Array<ArrayBuffer>> {
  const encoder = GIFEncoder();
  const count = Math.max(2, Math.round(GIF_RATE * seconds));
  const background = paper();
  await turn(stage, async (show) => {
    for (let frame = 0; frame < count && !signal.aborted; frame++) {
      show(frame / count);
      const rgba = pixels(stage, size, background);
      const palette = quantize(rgba, COLORS);
      encoder.writeFrame(applyPalette(rgba, palette), size.width, size.height, {
        palette,
        delay: 1000 / GIF_RATE,
      });
      progress((frame + 1) / count);
      await nextFrame(); // the page stays alive
    }
  });
  encoder.finish();
  return encoder.bytes();
}

const nextFrame = () => new Promise<number>((resolve) => requestAnimationFrame(resolve));
