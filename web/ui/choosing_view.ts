import type { Choice } from "../engine/choice.ts";
import type { RestMesh } from "../engine/rest_mesh.ts";
import { Choosing } from "./choosing.ts";
import { HandleList } from "./choosing_handles.ts";
import { listenToChoosingKeys } from "./choosing_keys.ts";
import { HandleMirror } from "./choosing_mirror.ts";
import { materialPanel, type Materials } from "./choosing_material.ts";
import { ToolOverlay } from "./choosing_overlay.ts";
import { PartList } from "./choosing_parts.ts";
import { samplingPanel, type Sampling } from "./choosing_sampling.ts";
import { selectPanel } from "./choosing_select_panel.ts";
import { ChoosingTools } from "./choosing_tools.ts";
import { choice, h, section, toggle } from "./dom.ts";
import { occlusionToggle } from "./look_panel.ts";
import type { Server } from "./server.ts";
import { CHOOSING, shortcutSheet } from "./shortcuts.ts";
import { VIEWS, type Axis, type Stage } from "./stage.ts";
import { Surface } from "./surface.ts";
import type { View, ViewOptions } from "./view.ts";

export interface ChoosingView extends View {
  readonly choosing: Choosing;
}

/** Choosing handles and parts: tools on the stage, their lists in the panel, with `below` under them. `onOther` is called
 * after changes outside the choice, such as the axis that points up. */
export function choosingView(
  stage: Stage,
  mesh: RestMesh,
  start: Choice,
  sampling: Sampling,
  materials: Materials,
  below: readonly HTMLElement[],
  server: Pick<Server, "ask">,
  onChoice: (choice: Choice) => void,
  onOther: () => void,
  options: ViewOptions,
): ChoosingView {
  // without modes: a shape at rest
  const space = {
    vertices: mesh.shape.length / 3,
    base: mesh.shape,
    modes: new Int16Array(0),
    scales: new Float32Array(0),
  };
  const surface = new Surface(stage.renderer, space, mesh.faces, mesh.diagonal, true);
  surface.object.updateMatrix();
  stage.root.add(surface.object);
  if (!options.keepView) stage.place(mesh.shape, options.up);
  const stop = new AbortController();
  const choosing = new Choosing(stage, mesh, surface, start);
  const overlay = new ToolOverlay();
  const tools = new ChoosingTools(choosing, overlay, stop.signal);
  const select = selectPanel(choosing, () => tools.refresh());
  const mirror = new HandleMirror(choosing, server);
  const handles = new HandleList(choosing, () => sampling, mirror);
  const parts = new PartList(choosing);
  listenToChoosingKeys(
    { choosing, tools, make: () => handles.make(), mirror: () => handles.mirror() },
    stop.signal,
  );
  stage.renderer.domElement.parentElement!.append(overlay.element, handles.floating);
  stage.beforeFrame = () => choosing.paint();
  stage.restored = () => surface.refresh();
  choosing.onChange = () => {
    select.update();
    handles.update();
    parts.update();
    onChoice(choosing.choice);
  };
  choosing.changed();

  const sheet = shortcutSheet(CHOOSING, (view) => stage.look(1, VIEWS[view]), stop.signal);
  const inside = insideCount(mesh);
  const counted =
    `${space.vertices.toLocaleString("en")} vertices` +
    (inside > 0 ? `, ${inside.toLocaleString("en")} of them inside` : "");
  return {
    choosing,
    hud: {
      element: h("header", { className: "hud" }, h("h1", {}, mesh.name), h("p", {}, counted)),
      notice: h("p", { className: "notice", role: "status", hidden: true }),
    },
    panel: [
      select.element,
      handles.element,
      materialPanel(sampling, materials, parts.element),
      samplingPanel(sampling, mesh.diagonal),
      lookPanel(stage, surface, mesh, options.up, onOther, sheet),
      ...below,
    ],
    script: {
      kind: "choosing",
      choosing,
      screen: (vertex: number) => choosing.screen(vertex),
      get handles() {
        return choosing.choice.handles.map(({ name, vertices }) => ({ name, vertices: [...vertices] }));
      },
      get parts() {
        return choosing.choice.parts.map(({ vertices, ...rest }) => ({ ...rest, vertices: [...vertices] }));
      },
      get selected() {
        return [...choosing.selected];
      },
    },
    dispose: () => {
      stop.abort();
      stage.beforeFrame = () => {};
      stage.restored = () => {};
      overlay.element.remove();
      handles.floating.remove();
      mirror.dispose();
      surface.object.removeFromParent();
      surface.dispose();
    },
  };
}

/** How many vertices are in no triangle of the surface. */
function insideCount({ shape, faces }: RestMesh): number {
  const isInside = new Uint8Array(shape.length / 3).fill(1);
  for (const vertex of faces) isInside[vertex] = 0;
  return isInside.reduce((count, one) => count + one, 0);
}

function lookPanel(
  stage: Stage,
  surface: Surface,
  mesh: RestMesh,
  up: Axis,
  onUp: () => void,
  sheet: HTMLElement,
): HTMLElement {
  const ups = choice<Axis>(
    "Up",
    [
      ["x", "x up"],
      ["y", "y up"],
      ["z", "z up"],
    ],
    up,
    (axis) => {
      stage.place(mesh.shape, axis);
      onUp();
    },
  );
  const wires = toggle("Wireframe", "W", false, (on) => {
    surface.wireframe = on;
    stage.draw();
  });
  wires.id = "wires";
  const reset = { type: "button", title: "F", id: "frame", onclick: () => stage.look() };
  const frame = h("button", reset, "Reset view");
  return section(
    "Look",
    ups.element,
    h("div", { className: "row" }, wires, occlusionToggle(stage, [surface]), frame, sheet),
  );
}
