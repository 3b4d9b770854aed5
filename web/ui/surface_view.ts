import { h } from "./dom.ts";
import type { MeshScene } from "./mesh_scene.ts";
import { shortcutSheet } from "./shortcuts.ts";
import { VIEWS, type Stage } from "./stage.ts";
import { isTaken } from "./taken_keys.ts";
import type { View } from "./view.ts";

export interface SurfaceView extends View {
  /** Leaves the scene to another view, which disposes of it; null if it is gone. */
  take(): MeshScene | null;
}

/** A surface without tets, to look at while it is filled or if it cannot be filled. */
export function surfaceView(stage: Stage, scene: MeshScene, below: readonly HTMLElement[]): SurfaceView {
  const stop = new AbortController();
  scene.sheet = shortcutSheet([], (view) => stage.look(1, VIEWS[view]), stop.signal);
  document.addEventListener("keydown", press, { signal: stop.signal });
  let isLeft = false;
  return {
    hud: meshHud(scene),
    label: "The surface.",
    panel: [scene.panel, ...below],
    script: { kind: "surface", scene },
    take: () => {
      isLeft = true;
      return scene.isDisposed ? null : scene;
    },
    dispose: () => {
      stop.abort();
      if (!isLeft) scene.dispose();
    },
  };
}

/** The name of a mesh and the number of its vertices. */
export function meshHud({ mesh }: MeshScene): View["hud"] {
  const inside = insideCount(mesh.shape.length / 3, mesh.faces);
  const counted =
    `${(mesh.shape.length / 3).toLocaleString("en")} vertices` +
    (inside > 0 ? `, ${inside.toLocaleString("en")} of them inside` : "");
  return {
    element: h("header", { className: "hud" }, h("h1", {}, mesh.name), h("p", {}, counted)),
    notice: h("p", { className: "notice", role: "status", hidden: true }),
  };
}

/** How many vertices are in no triangle of the surface. */
function insideCount(vertices: number, faces: Uint32Array): number {
  const isInside = new Uint8Array(vertices).fill(1);
  for (const vertex of faces) isInside[vertex] = 0;
  return isInside.reduce((count, one) => count + one, 0);
}

/** F and W, while no field has the focus. */
function press(event: KeyboardEvent): void {
  const { key, ctrlKey, metaKey, altKey } = event;
  if (ctrlKey || metaKey || altKey || isTaken(event) || document.querySelector("dialog[open]")) return;
  if (key.toLowerCase() === "f") document.getElementById("frame")?.click();
  if (key.toLowerCase() === "w") document.getElementById("wires")?.click();
}
