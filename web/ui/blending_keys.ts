import { isTaken } from "./taken_keys.ts";

/** Letters and the ids of the buttons that they press. */
const BUTTONS: Record<string, string> = { f: "frame", w: "wires", j: "jiggle", k: "add-key", p: "play-keys" };

/** Keys, while no field has the focus: Space plays, / searches the poses, F, W, J, K and P as in posing. */
export function listenToBlendingKeys(
  play: HTMLButtonElement,
  search: HTMLInputElement | null,
  signal: AbortSignal,
): void {
  const act = (event: KeyboardEvent) => {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (isTaken(event) || document.querySelector("dialog[open]")) return;
    const key = event.key.toLowerCase();
    if (key === " " && !(target instanceof HTMLElement && target.matches("button, summary, input")))
      play.click();
    else if (key === "/" && search) search.focus();
    else if (BUTTONS[key]) document.getElementById(BUTTONS[key])?.click();
    else return;
    event.preventDefault();
  };
  document.addEventListener("keydown", act, { signal });
}
