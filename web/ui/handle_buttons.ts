import { h } from "./dom.ts";
import { handleColor } from "./handle_colors.ts";
import type { Posing } from "./posing.ts";

/** A button for each handle, which selects it, or no handle if it is selected. */
export function handleButtons(posing: Posing): HTMLButtonElement[] {
  return posing.session.model.handles.map(({ name }, handle) => {
    const swatch = h("i", { className: "swatch", "aria-hidden": true });
    swatch.style.background = handleColor(handle);
    const act = () => posing.select(posing.selected === handle ? -1 : handle);
    return h("button", { type: "button", "aria-pressed": false, onclick: act }, swatch, name);
  });
}
