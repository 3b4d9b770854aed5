import type { Model } from "../engine/index.ts";
import { choice, h, section, slider, toggle } from "./dom.ts";
import type { Axis, Stage } from "./stage.ts";
import type { Surface } from "./surface.ts";

/** How many of the coordinates are solved for. */
export function qualitySection(dimension: number, act: (dimension: number) => void): HTMLElement {
  const range = { min: Math.min(4, dimension), max: dimension, step: 1, value: dimension };
  return section("Quality", slider("Dimensions", range, String, act).element);
}

/** Colours, wires, what is up, and the first view again. */
export function lookSection(stage: Stage, surfaces: Surface[], model: Model, up: Axis): HTMLElement {
  const each = (act: (surface: Surface) => void) => {
    surfaces.forEach(act);
    stage.draw();
  };
  const own = model.kind === "posing" ? "Handles" : "Clay";
  const colors = choice<"own" | "displacement">(
    "Colours",
    [
      ["own", own],
      ["displacement", "Displacement"],
    ],
    "own",
    (value) => each((surface) => (surface.displacementColors = value === "displacement")),
  );
  const wires = toggle("Wireframe", "W", false, (on) => each((surface) => (surface.wireframe = on)));
  wires.id = "wires";
  const ups = choice<Axis>(
    "Up",
    [
      ["x", "x up"],
      ["y", "y up"],
      ["z", "z up"],
    ],
    up,
    (axis) => stage.place(model.space.base, axis),
  );
  const frame = h(
    "button",
    { type: "button", title: "F", id: "frame", onclick: () => stage.look() },
    "Reset view",
  );
  return section("Look", colors.element, ups.element, h("div", { className: "row" }, wires, frame));
}
