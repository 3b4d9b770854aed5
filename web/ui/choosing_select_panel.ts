import type { Choosing, Tool } from "./choosing.ts";
import { choice, h, section, slider } from "./dom.ts";

const TOOLS = [
  ["brush", "Brush"],
  ["box", "Box"],
  ["lasso", "Lasso"],
  ["look", "Look"],
] as const;

const HINTS: Record<Tool, string> = {
  brush: "Paint over a part. Drag beside the body to look around.",
  box: "Draw a box over a part. Look around with the right button or two fingers.",
  lasso: "Draw a line around a part. Look around with the right button or two fingers.",
  look: "Drag to look around, scroll or pinch to come closer.",
};

/** Tools and what they do; `update` shows the present state. */
export function selectPanel(choosing: Choosing, onBrush: () => void) {
  const tools = choice<Tool>("Tool", TOOLS, choosing.tool, (tool) => {
    choosing.tool = tool;
    choosing.changed();
  });
  const modes = choice<"add" | "remove">(
    "What a tool does",
    [
      ["add", "Add"],
      ["remove", "Remove"],
    ],
    "add",
    (mode) => {
      choosing.removing = mode === "remove";
      choosing.changed();
    },
  );
  modes.element.title = "Alt removes, Shift adds";
  const depth = choice<"all" | "seen">(
    "How deep a tool reaches",
    [
      ["all", "Through"],
      ["seen", "Seen only"],
    ],
    "all",
    (value) => (choosing.seenOnly = value === "seen"),
  );
  depth.element.title = "Everything behind and inside as well, or only what is seen";
  const range = { min: 0.005, max: 0.3, step: 0.005, value: choosing.radius };
  const size = slider(
    "Brush",
    range,
    (share) => `${(100 * share).toFixed(1)} %`,
    (share) => {
      choosing.radius = share;
      onBrush();
    },
  );
  size.input.title = "[ and ]";
  const hint = h("p", { className: "hint" });
  const clear = h("button", { type: "button", title: "Escape", onclick: () => choosing.clear() }, "Clear");
  const undo = h("button", { type: "button", title: "Ctrl+Z", onclick: () => choosing.undo() }, "Undo");
  const redo = h(
    "button",
    { type: "button", title: "Ctrl+Shift+Z, Ctrl+Y", onclick: () => choosing.redo() },
    "Redo",
  );

  const update = () => {
    const { tool } = choosing;
    tools.set(tool);
    modes.set(choosing.removing ? "remove" : "add");
    modes.element.hidden = tool === "look";
    depth.element.hidden = tool === "look" || tool === "brush";
    size.element.hidden = tool !== "brush";
    size.set(choosing.radius);
    if (hint.textContent !== HINTS[tool]) hint.textContent = HINTS[tool];
    clear.disabled = choosing.selected.length === 0;
    undo.disabled = !choosing.canUndo;
    redo.disabled = !choosing.canRedo;
  };
  const element = section(
    "Select",
    tools.element,
    modes.element,
    size.element,
    depth.element,
    hint,
    h("div", { className: "row" }, clear, undo, redo),
  );
  return { element, update };
}
