import type { Choice } from "../engine/choice.ts";
import type { Workspace } from "../engine/messages.ts";
import { Choosing } from "./choosing.ts";
import { bodyPanel, type Forms } from "./choosing_body.ts";
import { HandleList } from "./choosing_handles.ts";
import { listenToChoosingKeys } from "./choosing_keys.ts";
import { HandleMirror } from "./choosing_mirror.ts";
import { materialPanel, type Materials } from "./choosing_material.ts";
import { ToolOverlay } from "./choosing_overlay.ts";
import { PartList } from "./choosing_parts.ts";
import { samplingPanel, type Sampling } from "./choosing_sampling.ts";
import { selectPanel } from "./choosing_select_panel.ts";
import { ChoosingTools } from "./choosing_tools.ts";
import { meshNotes } from "./mesh_notes.ts";
import type { MeshScene } from "./mesh_scene.ts";
import type { Server } from "./server.ts";
import { CHOOSING, shortcutSheet } from "./shortcuts.ts";
import { VIEWS, type Stage } from "./stage.ts";
import { meshHud } from "./surface_view.ts";
import type { View } from "./view.ts";

export interface ChoosingView extends View {
  readonly choosing: Choosing;
}

/** Choosing handles and parts: tools on the stage, their lists in the panel, with `below` under them. The view disposes of its
 * scene. The first thing that is chosen shows the colours of handles, which the user's own materials would hide. */
export function choosingView(
  stage: Stage,
  scene: MeshScene,
  start: Choice,
  sampling: Sampling,
  given: Materials & Forms & Pick<Workspace, "notices">,
  below: readonly HTMLElement[],
  server: Pick<Server, "ask">,
  acts: {
    /** Receives the present choice. */
    choose(choice: Choice): void;
    /** Fills the surface with tets. */
    fill(): void;
  },
): ChoosingView {
  const { mesh, surface } = scene;
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
  stage.renderer.canvas.parentElement!.append(overlay.element, handles.floating);
  stage.beforeFrame = () => choosing.paint();
  let isBare = true;
  choosing.onChange = () => {
    const { selected, choice } = choosing;
    const wasBare = isBare;
    isBare = selected.length + choice.handles.length + choice.parts.length === 0;
    if (wasBare && !isBare) scene.colors = "own";
    select.update();
    handles.update();
    parts.update();
    acts.choose(choosing.choice);
  };
  const material = materialPanel(sampling, given, parts.element);
  const body = bodyPanel(
    sampling,
    given,
    () => acts.fill(),
    () => {
      material.update();
      acts.choose(choosing.choice);
    },
  );
  choosing.changed();

  scene.sheet = shortcutSheet(CHOOSING, (view) => stage.look(1, VIEWS[view]), stop.signal);
  return {
    choosing,
    hud: meshHud(scene),
    label: "The body. Keys: arrows move the brush, Space paints, Enter makes a handle.",
    panel: [
      ...meshNotes(given.notices ?? []),
      ...body,
      select.element,
      handles.element,
      material.element,
      samplingPanel(sampling, given.diagonal),
      scene.panel,
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
      overlay.element.remove();
      handles.floating.remove();
      mirror.dispose();
      scene.dispose();
    },
  };
}
