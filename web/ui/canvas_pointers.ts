interface PointerActions {
  down(event: PointerEvent): void;
  move(event: PointerEvent): void;
  up(event: PointerEvent): void;
  cancel(event: PointerEvent): void;
}

/** Hears the pointer on a canvas before the camera's controls do, until the signal. */
export function listenToPointers(canvas: HTMLCanvasElement, acts: PointerActions, signal: AbortSignal): void {
  const shell = canvas.parentElement!;
  const options = { capture: true, signal };
  shell.addEventListener("pointerdown", acts.down, options);
  shell.addEventListener("pointermove", acts.move, options);
  shell.addEventListener("pointerup", acts.up, options);
  shell.addEventListener("pointercancel", acts.cancel, options);
}
