import type { RestMesh } from "../engine/rest_mesh.ts";
import { choice, h, section, toggle } from "./dom.ts";
import { CLAY } from "./handle_colors.ts";
import { occlusionToggle } from "./look_panel.ts";
import { nextTask } from "./next_task.ts";
import { OwnLook } from "./own_look.ts";
import type { Axis, Stage } from "./stage.ts";
import { Surface } from "./surface.ts";
import type { ViewOptions } from "./view.ts";

type Shown = "own" | "material";

/** A mesh at rest on the stage, and the panel of how it looks. Views of it can follow each other: what it looks like stays. */
export class MeshScene {
  readonly mesh: RestMesh;
  readonly surface: Surface;
  readonly panel: HTMLElement;
  /** After another axis points up. */
  onUp: () => void = () => {};
  readonly #stage: Stage;
  readonly #look: OwnLook | null;
  readonly #colors: ReturnType<typeof choice<Shown>>;
  readonly #row: HTMLElement;
  #isColored = false;
  #isDisposed = false;

  /** Works in several tasks, since the mesh may be large. */
  static async create(stage: Stage, mesh: RestMesh, options: ViewOptions): Promise<MeshScene> {
    const look = OwnLook.of(mesh.appearance, stage.renderer.graphics);
    await nextTask();
    // without modes: a shape at rest
    const space = {
      vertices: mesh.shape.length / 3,
      base: mesh.shape,
      modes: new Int16Array(0),
      scales: new Float32Array(0),
    };
    const surface = new Surface(stage.renderer.graphics, space, mesh.faces, mesh.diagonal, true, null, look);
    surface.paint(() => CLAY);
    await nextTask();
    const scene = new MeshScene(stage, mesh, surface, look, options.up);
    await nextTask();
    stage.root.add(surface.object);
    if (!options.keepView) stage.place(mesh.shape, options.up);
    return scene;
  }

  private constructor(stage: Stage, mesh: RestMesh, surface: Surface, look: OwnLook | null, up: Axis) {
    [this.mesh, this.surface, this.#stage, this.#look] = [mesh, surface, stage, look];
    surface.object.updateMatrix();
    stage.restored = () => surface.refresh();
    const options = [
      ["material", "Material"],
      ["own", "Handles"],
    ] as const;
    this.#colors = choice<Shown>("Colours", options, "own", (colors) => this.#color(colors));
    this.#colors.element.hidden = !look;
    const axes = (["x", "y", "z"] as const).map((axis) => [axis, `${axis} up`] as const);
    const ups = choice<Axis>("Up", axes, up, (axis) => {
      stage.place(mesh.shape, axis);
      this.onUp();
    });
    const wires = toggle("Wireframe", "W", false, (on) => {
      surface.wireframe = on;
      stage.draw();
    });
    wires.id = "wires";
    const reset = { type: "button", title: "F", id: "frame", onclick: () => stage.look() };
    this.#row = h(
      "div",
      { className: "row" },
      wires,
      occlusionToggle(stage, [surface]),
      h("button", reset, "Reset view"),
      h("span"), // the place of the sheet
    );
    this.panel = section("Look", this.#colors.element, ups.element, this.#row);
    void look?.ready.then(() => {
      if (!this.#isColored) this.colors = "material";
    });
  }

  /** The user's own materials, if the mesh has some; or the colours of handles. */
  set colors(colors: Shown) {
    if (this.#isDisposed || (colors === "material" && !this.#look)) return;
    this.#colors.set(colors);
    this.#color(colors);
  }

  /** The button for the shortcuts of the present view. */
  set sheet(button: HTMLElement) {
    this.#row.lastElementChild!.replaceWith(button);
  }

  get isDisposed(): boolean {
    return this.#isDisposed;
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#stage.restored = () => {};
    this.surface.object.removeFromParent();
    this.surface.dispose();
    this.#look?.dispose();
  }

  #color(colors: Shown): void {
    this.#isColored = true;
    this.surface.colors = colors;
    this.#stage.draw();
  }
}
