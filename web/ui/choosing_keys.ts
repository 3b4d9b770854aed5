import type { Choosing, Tool } from "./choosing.ts";
import type { ChoosingTools } from "./choosing_tools.ts";
import { isTaken } from "./taken_keys.ts";

const TOOLS: Record<string, Tool> = { b: "brush", x: "box", l: "lasso", v: "look" };
const STEP = 14; // pixels

export interface ChoosingKeys {
  choosing: Choosing;
  tools: ChoosingTools;
  make(): void;
  mirror(): void;
}

/** Keys, while no field has the focus: B, X, L, V tools; A, D add or remove; [ ] brush; Enter a handle; M its mirror image; Escape;
 * Ctrl+Z, Ctrl+Shift+Z, Ctrl+Y; F, W. With the focus on the stage arrows move the brush, and Space paints. */
export function listenToChoosingKeys(keys: ChoosingKeys, signal: AbortSignal): void {
  document.addEventListener("keydown", (event) => handle(keys, event), { signal });
}

function handle(keys: ChoosingKeys, event: KeyboardEvent): void {
  if (document.querySelector("dialog[open]")) return;
  if (isTaken(event)) return;
  const { choosing } = keys;
  if (choosing.isBusy && event.key !== "Escape") {
    if (!["Alt", "Shift", "Control", "Meta"].includes(event.key)) event.preventDefault();
    return;
  }
  const key = event.key.toLowerCase();
  if (event.ctrlKey || event.metaKey) {
    if (key !== "z" && !(key === "y" && event.ctrlKey)) return;
    if (key === "y" || event.shiftKey) choosing.redo();
    else choosing.undo();
  } else if (event.target === choosing.stage.renderer.canvas && brushKey(keys, event)) {
    // taken
  } else if (key === "escape") {
    if (!keys.tools.cancel()) choosing.clear();
  } else if (key === "enter" && !isPressable(event.target)) {
    keys.make();
  } else if (key === "m") {
    keys.mirror();
  } else if (!letter(keys, key)) {
    return;
  }
  event.preventDefault();
}

function brushKey({ choosing, tools }: ChoosingKeys, event: KeyboardEvent): boolean {
  if (choosing.tool !== "brush") return false;
  const step = event.shiftKey ? STEP / 4 : STEP;
  if (event.key === "ArrowLeft") tools.moveCursor(-step, 0);
  else if (event.key === "ArrowRight") tools.moveCursor(step, 0);
  else if (event.key === "ArrowUp") tools.moveCursor(0, -step);
  else if (event.key === "ArrowDown") tools.moveCursor(0, step);
  else if (event.key === " ") tools.dab(event.altKey || choosing.removing);
  else return false;
  return true;
}

function letter({ choosing, tools }: ChoosingKeys, key: string): boolean {
  if (key in TOOLS) choosing.tool = TOOLS[key];
  else if (key === "a" || key === "d") choosing.removing = key === "d";
  else if (key === "[" || key === "]") {
    choosing.radius = Math.min(Math.max(choosing.radius * (key === "[" ? 0.85 : 1 / 0.85), 0.005), 0.3);
    tools.refresh();
  } else if (key === "f") document.getElementById("frame")?.click();
  else if (key === "w") document.getElementById("wires")?.click();
  else return false;
  choosing.changed();
  return true;
}

function isPressable(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && target.matches("button, summary, a");
}
