import type { Workspace as Given } from "../engine/messages.ts";
import { readMesh } from "../engine/rest_mesh.ts";
import type { AppShell } from "./app_shell.ts";
import { CheckPanel } from "./check_panel.ts";
import { MeshScene } from "./mesh_scene.ts";
import { nextTask } from "./next_task.ts";
import type { Server } from "./server.ts";
import { surfaceView, type SurfaceView } from "./surface_view.ts";
import type { View } from "./view.ts";

/** The mesh that the server opens, on the stage: a surface is looked at before it has tets, and can be checked. */
export class WorkspaceSurface {
  readonly #shell: AppShell;
  readonly #server: Server;
  /** Until there are tets. */
  #view: SurfaceView | null = null;
  #shown: string | null = null;
  /** The check of the present mesh; null if it came as tets. */
  #check: CheckPanel | null = null;

  constructor(shell: AppShell, server: Server) {
    [this.#shell, this.#server] = [shell, server];
  }

  get check(): CheckPanel | null {
    return this.#check;
  }

  /** The scene of a mesh: the one that is shown without tets, or a new one. `leave` removes what is shown before that. */
  async scene(given: Given, leave: () => void): Promise<MeshScene> {
    const isFilled = given.kind === "surface" || (given.is_filled ?? false);
    const scene = this.#shown === given.mesh ? this.#view?.take() : null;
    this.#view = null;
    if (scene) return scene;
    const { stage } = this.#shell; // made while the mesh comes
    const mesh = readMesh(await this.#server.fetched(given.mesh!));
    await nextTask();
    leave();
    this.#check?.dispose();
    this.#check = given.has_surface ? new CheckPanel(stage, this.#server) : null;
    if (this.#check) this.#check.isFilled = isFilled;
    return MeshScene.create(stage, mesh, this.#shell.options(mesh.up));
  }

  /** Shows a mesh without tets. */
  async look(given: Given, leave: () => void): Promise<void> {
    const scene = await this.scene(given, leave);
    leave();
    const view = surfaceView(this.#shell.stage, scene, this.#check?.elements ?? []);
    [this.#view, this.#shown] = [view, given.mesh];
    this.show(view, scene.mesh.name);
  }

  /** Shows a view of the mesh, with the faces that close its holes if it has been checked. */
  show(view: View, name: string): void {
    const check = this.#check;
    const dispose = () => {
      check?.hide();
      view.dispose();
    };
    this.#shell.show({ ...view, dispose }, name);
    check?.show();
  }
}
