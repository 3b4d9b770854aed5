/** Pixels that the pointer moves before a press becomes a drag. */
export const LEAST_WAY = 2;

interface PointerActions {
  down(event: PointerEvent): void;
  move(event: PointerEvent): void;
  up(event: PointerEvent): void;
  cancel(event: PointerEvent): void;
}

/** Listens to the pointer on a canvas, before the camera's controls, until the signal. */
export function listenToPointers(canvas: HTMLCanvasElement, acts: PointerActions, signal: AbortSignal): void {
  const parent = canvas.parentElement!;
  const options = { capture: true, signal };
  parent.addEventListener("pointerdown", acts.down, options);
  parent.addEventListener("pointermove", acts.move, options);
  parent.addEventListener("pointerup", acts.up, options);
  parent.addEventListener("pointercancel", acts.cancel, options);
}
