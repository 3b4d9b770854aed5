import {
  choiceOf,
  lacking,
  handleMessages,
  orderedHandleMessages,
  withKept,
  type Choice,
} from "../engine/choice.ts";
import { partMessages } from "../engine/parts.ts";
import type { PosingModel } from "../engine/index.ts";
import type { Workspace as Given } from "../engine/messages.ts";
import type { RestMesh } from "../engine/rest_mesh.ts";
import { CHOOSING, keepHash, stateOf } from "./address.ts";
import { ConnectionNotice } from "./connection_notice.ts";
import { samplingOf, type Sampling } from "./choosing_sampling.ts";
import { choosingView } from "./choosing_view.ts";
import type { Improving } from "./improving.ts";
import { MeshScene } from "./mesh_scene.ts";
import { nextTask } from "./next_task.ts";
import type { PosingView } from "./posing_view.ts";
import { readable, type AppShell } from "./app_shell.ts";
import { ServedModels } from "./served_models.ts";
import type { View, ViewState } from "./view.ts";
import { Refused, type Server } from "./server.ts";
import { ReadingBox } from "./workspace_reading.ts";
import { WorkspaceSurface } from "./workspace_surface.ts";

/** Work with a server: a mesh, its handles, models that become better while they are posed. */
export class Workspace {
  readonly #shell: AppShell;
  readonly #server: Server;
  readonly #models: ServedModels;
  readonly #reading: ReadingBox;
  readonly #surface: WorkspaceSurface;
  #given: Given | null = null;
  #mesh: RestMesh | null = null;
  #choice: Choice = choiceOf([]);
  #sampling: Sampling | null = null;
  /** Whether a lost connection is back, until its mesh has come. */
  #isBack = false;
  /** Whether handles are chosen although there is a model, as before the page was loaded again. */
  #staysChoosing = location.hash === CHOOSING;
  #keeping = 0;
  #begun!: (given: Given | null) => void;
  /** The first workspace; null if there is no connection. */
  readonly begun = new Promise<Given | null>((resolve) => (this.#begun = resolve));
  /** Workspaces and models are taken one after the other. */
  #queue: Promise<void> = Promise.resolve();

  constructor(shell: AppShell, server: Server) {
    [this.#shell, this.#server] = [shell, server];
    this.#reading = new ReadingBox(shell, server, (thickness) => this.#reopen(thickness));
    this.#surface = new WorkspaceSurface(shell, server);
    const workspace = this;
    const models = (this.#models = new ServedModels(shell, server, {
      get name() {
        return workspace.#given!.name;
      },
      get folder() {
        return workspace.#given!.folder;
      },
      get lacking() {
        return workspace.#mesh ? lacking(workspace.#choice) : "";
      },
      get staysChoosing() {
        return workspace.#staysChoosing;
      },
      compute: () => this.#compute(),
      leave: () => this.leave(),
      choose: () => (this.#mesh ? this.#backToChoosing() : this.edit()),
      send: () => this.#sendChoice(),
      add: (kept) => {
        if (!models.isPosing || kept.length === 0) return; // handles that are being chosen stay as they are shown
        this.#choice = withKept(this.#choice, kept);
        this.#keepSoon();
      },
      try: (act) => this.#try(act),
    }));
    server.on("workspace", (given) => {
      this.#begun(given);
      this.#later(() => this.#enter(given));
    });
    server.on(
      "progress",
      (progress) =>
        progress.request === 0
          ? this.#reading.progress(progress)
          : this.#later(() => models.progress(progress)), // after the workspace, which names its request
    );
    server.on("model", (model) => {
      models.announce(model);
      this.#later(() => models.take(model));
    });
    server.on("failed", ({ request, message }) =>
      this.#later(() => (request === 0 ? this.#reading.failed(message) : models.fails(request, message))),
    );
    const notice = new ConnectionNotice(server);
    document.body.append(notice.element);
    server.onConnection = (connection) => {
      notice.show(connection);
      models.update();
      if (connection === "open") return models.panel.fault(""); // which was that there is none
      this.#begun(null);
      if (!this.#mesh) this.#reading.lose();
    };
    for (const type of ["input", "change"])
      document.getElementById("panel")!.addEventListener(type, () => this.#keepSoon());
    window.addEventListener("pagehide", () => this.#keep());
  }

  /** Starts choosing handles on the body of a model, the server's own one or that of a file; `state` is where it is left. */
  edit(state: ViewState = {}, file?: File): void {
    void this.#try(() => {
      if (file) this.upload(file);
      else this.#server.send({ type: "edit" });
      this.#staysChoosing = true;
      this.#models.state = state;
    });
  }

  /** Leaves the view that is shown, before another one. */
  leave(): void {
    this.#models.leave();
    this.#shell.clear();
  }

  /** The number of the model that is shown, at the server. */
  get shownModel(): number {
    return this.#models.number;
  }

  get improving(): Improving {
    return this.#models.improving;
  }

  /** Adopts the server's own model, which can be improved while it is posed. */
  adopt(content: PosingModel, view: PosingView): View {
    return this.#models.adopt(content, view);
  }

  /** Opens another mesh from a file. */
  upload(file: File): void {
    if (this.#given) void this.#reading.upload(file, this.#given);
  }

  async #enter(given: Given): Promise<void> {
    const [before, models] = [this.#given, this.#models];
    this.#given = given;
    if (given.kind === "model") {
      // the page shows it, or a better one that follows
      if (!models.isPosing) models.state = stateOf(location.hash);
      models.job.set(given.job ?? 0, given.is_running ?? false);
      models.update();
      return;
    }
    if (this.#mesh && before?.id !== given.id) {
      this.#isBack = true; // the connection was lost; what was chosen here stays
      if (given.kind === "empty")
        models.panel.fault("The server no longer has the mesh. Drop it here again.");
    }
    if (given.mesh === null) {
      if (!this.#isBack) this.#await(given);
      return;
    }
    if (given.kind === "surface") {
      if (this.#isBack) return; // its tets follow
      this.#mesh = null;
      await this.#surface.look(given, () => this.leave());
      this.#reading.fill(given);
      return;
    }
    const isSame = this.#mesh?.name === given.name && this.#mesh.diagonal === given.diagonal;
    if (this.#isBack && isSame) {
      if (models.job.isRunning)
        models.panel.fault("The server no longer has the computation. Compute again.");
      this.#isBack = false;
      models.job.end();
      models.update();
      this.#keep();
      return;
    }
    if (this.#mesh && before?.id === given.id && before.mesh === given.mesh) {
      models.job.set(given.job ?? 0, given.is_running ?? false); // the newest model and the progress follow
      models.update();
      return;
    }
    this.#isBack = false;
    this.#reading.done();
    const scene = await this.#surface.scene(given, () => this.leave());
    this.#mesh = { ...scene.mesh, diagonal: given.diagonal };
    this.#choice = choiceOf(given.handles, given.parts);
    this.#sampling = samplingOf(given);
    models.clear();
    models.job.set(given.job ?? 0, given.is_running ?? false);
    if (!before) models.state = stateOf(location.hash); // after a reload
    await this.#choosing(scene);
    if (this.#staysChoosing) keepHash(() => CHOOSING);
    if (before?.kind === "surface") this.#keepSoon(); // what points up
  }

  /** Fills the surface, or takes it as a shell; what was chosen stays. */
  #reopen(thickness: number | null): void {
    this.#keep();
    const refused = (error: Error) => this.#reading.failed(error.message);
    this.#server.ask({ type: "reopen", thickness }, "reopened").catch(refused);
  }

  /** Shows that there is no mesh: asks for one, or waits for it. */
  #await(given: Given): void {
    this.#mesh = null;
    this.#models.leave();
    this.#shell.empty();
    if (given.kind === "empty") this.#reading.ask(given);
    else this.#reading.wait(given);
  }

  /** The view in which handles are chosen; made and shown in several tasks, because the mesh may be large. */
  async #choosing(given: MeshScene | null = null): Promise<void> {
    const [stage, mesh] = [this.#shell.stage, this.#mesh!];
    if (!given) this.leave();
    const options = { up: stage.up, forceCpu: true, keepView: true };
    const scene = given ?? (await MeshScene.create(stage, mesh, options));
    scene.onUp = () => this.#keepSoon();
    const onChoice = (choice: Choice) => {
      if (choice.handles !== this.#choice.handles || choice.parts !== this.#choice.parts)
        this.#models.panel.clear();
      this.#choice = choice;
      this.#models.update();
      this.#keepSoon();
    };
    const view = choosingView(
      stage,
      scene,
      this.#choice,
      this.#sampling!,
      this.#given!,
      [...(this.#surface.check?.elements ?? []), this.#models.panel.element],
      this.#server,
      { choose: onChoice, fill: () => this.#reopen(null) },
    );
    await nextTask();
    if (given) this.leave(); // now, so that its surface stays visible
    this.#surface.show(view, mesh.name);
    this.#models.update();
  }

  async #backToChoosing(): Promise<void> {
    const choosing = this.#choosing(); // posing, which has an address of its own, is left at once
    keepHash(() => CHOOSING);
    await choosing;
  }

  /** Sends the choice to the server soon. */
  #keepSoon(): void {
    if (!this.#keeping) this.#keeping = window.setTimeout(() => this.#keep(), KEEP_PAUSE);
  }

  /** Sends the choice to the server, so that a reload finds it. */
  #keep(): void {
    clearTimeout(this.#keeping);
    this.#keeping = 0;
    if (!this.#mesh || !this.#sampling || !this.#server.isOpen) return;
    const { seed: _, ...sampling } = this.#sampling;
    const [handles, parts] = [handleMessages(this.#choice.handles), partMessages(this.#choice.parts)];
    this.#server.send({ type: "keep", handles, parts, ...sampling, up: this.#shell.stage.up });
  }

  async #compute(): Promise<void> {
    const models = this.#models;
    if (!models.panel.isValid()) return;
    await this.#sendChoice();
    const { translation: _, angle: __, thickness: ___, ...wanted } = this.#sampling!;
    this.#staysChoosing = false;
    keepHash(() => "");
    this.#keep();
    models.order({ type: "compute", ...wanted });
  }

  async #sendChoice(): Promise<void> {
    const { translation, angle, thickness } = this.#sampling!;
    const [handles, parts] = [orderedHandleMessages(this.#choice.handles), partMessages(this.#choice.parts)];
    await this.#server.ask({ type: "choose", handles, translation, angle, parts, thickness }, "chosen");
  }

  #later(act: () => Promise<void> | void): void {
    this.#queue = this.#queue.then(() => this.#try(act));
  }

  async #try(act: () => Promise<void> | void): Promise<void> {
    try {
      await act();
    } catch (error) {
      if (error instanceof Refused) this.#models.panel.fault(error.message);
      else this.#shell.showMessage(readable(error), true);
    }
  }
}

const KEEP_PAUSE = 150; // milliseconds: a brush changes the choice with every move
