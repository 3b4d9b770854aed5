interface PointerActs {
  down(event: PointerEvent): void;
  move(event: PointerEvent): void;
  up(event: PointerEvent): void;
  cancel(event: PointerEvent): void;
}

/** Hears the pointer on a canvas before the camera's controls do, until the signal. */
export function listenToPointers(canvas: HTMLCanvasElement, acts: PointerActs, signal: AbortSignal): void {
  const room = canvas.parentElement!;
  const options = { capture: true, signal };
  room.addEventListener("pointerdown", acts.down, options);
  room.addEventListener("pointermove", acts.move, options);
  room.addEventListener("pointerup", acts.up, options);
  room.addEventListener("pointercancel", acts.cancel, options);
}
