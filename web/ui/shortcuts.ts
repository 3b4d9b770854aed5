import { h } from "./dom.ts";
import { isTaken } from "./taken_keys.ts";

/** Keys and what they do. */
export type Shortcuts = readonly (readonly [string, string])[];

export const POSING: Shortcuts = [
  ["Drag a handle", "move it; with Shift, or after Turn, turn it"],
  ["1 to 9", "select a handle"],
  ["Arrows", "move or turn the selected handle"],
  ["T", "move or turn"],
  ["L, S", "the handle's own axes, snap"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
  ["R", "reset"],
  ["M", "mirror the pose"],
  ["J", "jiggle"],
  ["K, P", "add a key, play"],
  ["Escape", "cancel a drag, select nothing"],
];
export const CHOOSING: Shortcuts = [
  ["B, X, L, V", "brush, box, lasso, look"],
  ["A, D", "add or remove; Alt and Shift do it for one stroke"],
  ["[, ]", "smaller or larger brush"],
  ["Enter", "a handle of the selection"],
  ["M", "mirror image of the focused or last handle"],
  ["Arrows, Space", "with the focus on the stage: move the brush, paint"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
  ["Escape", "cancel a stroke, clear the selection"],
];
export const BLENDING: Shortcuts = [
  ["Space", "walk through the poses"],
  ["/", "search for a pose"],
  ["J", "jiggle"],
  ["K, P", "add a key, play the keys"],
];
const LOOKING: Shortcuts = [
  ["Drag beside the shape", "look around"],
  ["Wheel, right drag, two fingers", "come nearer, move the view"],
  ["7, 8, 9 of the number pad", "from above, the front, the side"],
  ["F", "first view"],
  ["W", "wireframe"],
  ["?", "these keys"],
];
const PADS: Record<string, string> = { Numpad7: "top", Numpad8: "front", Numpad9: "side" };

/** The sheet of shortcuts: `?` shows it, and a button. `look` gets the name of a view. */
export function shortcutSheet(
  own: Shortcuts,
  look: (view: string) => void,
  signal: AbortSignal,
): HTMLButtonElement {
  const rows = [...own, ...LOOKING].flatMap(([keys, does]) => [h("dt", {}, keys), h("dd", {}, does)]);
  const close = h("button", { type: "button", onclick: () => sheet.close() }, "Close");
  const sheet = h(
    "dialog",
    { className: "shortcuts" },
    h("h2", {}, "Shortcuts"),
    h("dl", {}, ...rows),
    close,
  );
  sheet.setAttribute("aria-label", "Shortcuts");
  document.body.append(sheet);
  signal.addEventListener("abort", () => sheet.remove());
  const show = () => (sheet.open ? sheet.close() : sheet.showModal());
  document.addEventListener(
    "keydown",
    (event) => {
      const view = PADS[event.code];
      if (isTaken(event)) return;
      if (event.key === "?") show();
      else if (view && !event.ctrlKey && !event.altKey) look(view);
      else return;
      event.preventDefault();
    },
    { signal },
  );
  return h("button", { type: "button", title: "?", onclick: show }, "Shortcuts");
}
