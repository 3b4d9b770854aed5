import { Vector3 } from "three";

import { turnedInView } from "./posing_drag.ts";
import type { Posing } from "./posing.ts";
import { isTaken } from "./taken_keys.ts";

const STEP = 0.015; // share of the diagonal
const TURN = Math.PI / 36;

/** Keys, while no field has the focus: 1-9 select, arrows move or turn, Ctrl+Z, Ctrl+Shift+Z and Ctrl+Y, T, R, F, W, J,
 * K, P, L, S, M, Escape. In a drag Escape takes it back, and no other key does anything. */
export function listenToKeys(posing: Posing, signal: AbortSignal): void {
  const press = (button: string) => document.getElementById(button)?.click();
  document.addEventListener("keydown", (event) => actOn(event, posing, press), { signal });
}

/** Does what a key asks for; `press` presses the button with an id. */
export function actOn(event: KeyboardEvent, posing: Posing, press: (button: string) => void): void {
  if (document.querySelector("dialog[open]")) return;
  if (posing.isDragging) {
    if (event.key === "Escape") posing.cancelDrag();
    event.preventDefault();
    return;
  }
  if (isTaken(event)) return;
  if (event.code.startsWith("Numpad")) return; // views
  if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z") {
    event.shiftKey ? posing.redo() : posing.undo();
  } else if (event.ctrlKey && event.key.toLowerCase() === "y") {
    posing.redo();
  } else if (event.ctrlKey || event.metaKey || event.altKey) {
    return;
  } else if (/^[1-9]$/.test(event.key) && Number(event.key) <= posing.session.model.handles.length) {
    posing.select(Number(event.key) - 1);
  } else if (event.key.startsWith("Arrow") && posing.selected >= 0) {
    step(posing, event.key);
  } else if (event.key === "Escape") {
    posing.select(-1);
  } else if (!letter(posing, event.key.toLowerCase(), press)) {
    return;
  }
  event.preventDefault();
}

const BUTTONS: Record<string, string> = {
  f: "frame",
  w: "wires",
  j: "jiggle",
  k: "add-key",
  p: "play-keys",
  l: "own-axes",
  s: "snap",
  m: "mirror-pose",
};

function letter(posing: Posing, key: string, press: (button: string) => void): boolean {
  if (key === "t") posing.setMode(posing.mode === "move" ? "turn" : "move");
  else if (key === "r") posing.reset();
  else if (BUTTONS[key]) press(BUTTONS[key]);
  else return false;
  return true;
}

function step(posing: Posing, key: string): void {
  const across = key === "ArrowLeft" ? -1 : key === "ArrowRight" ? 1 : 0;
  const up = key === "ArrowDown" ? -1 : key === "ArrowUp" ? 1 : 0;
  const { selected, session, stage } = posing;
  const before = posing.motion(selected);
  if (posing.mode === "turn") {
    posing.edit([[selected, turnedInView(posing, before, across * TURN, -up * TURN)]]);
  } else {
    const size = STEP * session.model.diagonal;
    const shift = new Vector3(across, up, 0).applyQuaternion(stage.camera.quaternion);
    const [x, y, z] = shift
      .applyQuaternion(stage.root.quaternion.clone().invert())
      .multiplyScalar(size)
      .toArray();
    const t = before.translation;
    const translation = [t[0] + x, t[1] + y, t[2] + z] as const;
    posing.edit([[selected, { rotation: before.rotation, translation }]]);
  }
}
