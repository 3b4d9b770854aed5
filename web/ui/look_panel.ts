import type { Model } from "../engine/index.ts";
import { choice, h, section, slider, toggle } from "./dom.ts";
import { Legend } from "./legend.ts";
import { Occlusion } from "./occlusion.ts";
import { VIEWS, type Axis, type Stage } from "./stage.ts";
import { showMaterial } from "./show_material.ts";
import type { Colors, Surface } from "./surface.ts";

/** How many of the coordinates are solved for, and what else belongs to it. */
export function qualitySection(
  dimension: number,
  act: (dimension: number) => void,
  ...others: HTMLElement[]
): HTMLElement {
  const range = { min: Math.min(4, dimension), max: dimension, step: 1, value: dimension };
  return section("Quality", slider("Dimensions", range, String, act).element, ...others);
}

/** The switch of ambient occlusion, which is on at first. */
export function occlusionToggle(stage: Stage, surfaces: readonly Surface[]): HTMLElement {
  const isPossible = Occlusion.supports(stage.renderer.graphics);
  const show = (on: boolean) => {
    for (const surface of surfaces) surface.occluded = on;
    stage.draw();
  };
  const title = isPossible
    ? "Ambient occlusion: less of the light from all sides reaches creases"
    : "This browser cannot draw into float textures";
  const button = toggle("Occlusion", title, isPossible, show);
  button.id = "occlusion";
  button.disabled = !isPossible;
  if (isPossible) show(true);
  return button;
}

/** Colours, wires, what is up, and the first view again. */
export function lookSection(
  stage: Stage,
  surfaces: Surface[],
  model: Model,
  up: Axis,
  ...others: HTMLElement[]
) {
  const each = (act: (surface: Surface) => void) => {
    surfaces.forEach(act);
    stage.draw();
  };
  const own = model.kind === "posing" ? "Handles" : "Clay";
  const legend = new Legend(stage, surfaces);
  const look = surfaces[0].look;
  const colors = choice<Colors>(
    "Colours",
    [
      ...(look ? ([["material", "Material"]] as const) : []),
      ["own", own],
      ["displacement", "Displaced"],
      ["strain", "Strain"],
    ],
    "own",
    (value) => {
      each((surface) => (surface.colors = value));
      legend.colors = value;
    },
  );
  void showMaterial(stage, surfaces).then((shown) => {
    if (shown) colors.set("material");
  });
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
  const views = Object.entries(VIEWS).map(([name, from]) => {
    const label = name.charAt(0).toUpperCase() + name.slice(1);
    return h("button", { type: "button", onclick: () => stage.look(1, from) }, label);
  });
  const rows = [
    h("div", { className: "row" }, ...views, frame),
    h("div", { className: "row" }, wires, occlusionToggle(stage, surfaces), ...others),
  ];
  return { element: section("Look", colors.element, legend.element, ups.element, ...rows), legend };
}
