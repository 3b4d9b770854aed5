import { choiceOf, lacking, handleMessages, orderedHandleMessages, type Choice } from "../engine/choice.ts";
import { partMessages } from "../engine/parts.ts";
import type { PosingModel } from "../engine/index.ts";
import type { Failed, Model, Progress, Workspace as Given } from "../engine/messages.ts";
import { readMesh, type RestMesh } from "../engine/rest_mesh.ts";
import { CheckPanel } from "./check_panel.ts";
import { CHOOSING, keepHash, motionsOf } from "./address.ts";
import { ConnectionNotice } from "./connection_notice.ts";
import { exportPage } from "./export_page.ts";
import { samplingOf, type Sampling } from "./choosing_sampling.ts";
import { choosingView } from "./choosing_view.ts";
import { ComputePanel } from "./compute_panel.ts";
import { polishAt } from "./polishing.ts";
import { posingView, type PosingView } from "./posing_view.ts";
import { readable, type AppShell } from "./app_shell.ts";
import type { Motions } from "./view.ts";
import { SentModels } from "./sent_models.ts";
import { Refused, type Server } from "./server.ts";
import { ReadingBox } from "./workspace_reading.ts";

/** Work with a server: a mesh, its handles, models that become better while they are posed. */
export class Workspace {
  readonly #shell: AppShell;
  readonly #server: Server;
  readonly #panel: ComputePanel;
  readonly #reading: ReadingBox;
  /** Of the present mesh; null if it came as tets. */
  #check: CheckPanel | null = null;
  #given: Given | null = null;
  #mesh: RestMesh | null = null;
  #choice: Choice = choiceOf([]);
  #sampling: Sampling | null = null;
  /** The newest model of the computation that was started last. */
  #model: { sent: Model; content: PosingModel } | null = null;
  readonly #models = new SentModels();
  #posing: PosingView | null = null;
  /** Where the handles were when posing was left. */
  #motions: Motions = new Map();
  /** Number of the request that computes, or 0. */
  #job = 0;
  #isRunning = false;
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
    this.#reading = new ReadingBox(shell, server);
    this.#panel = new ComputePanel({
      compute: () => void this.#try(() => this.#compute()),
      cancel: () => void this.#try(() => this.#cancel()),
      save: () => void this.#try(() => this.#save()),
      exportPage: () => exportPage(this.#model!),
      choose: () => void this.#try(() => this.#backToChoosing()),
      pose: () => void this.#try(() => this.#pose()),
    });
    server.on("workspace", (given) => {
      this.#begun(given);
      this.#later(() => this.#enter(given));
    });
    server.on("progress", (progress) => this.#progress(progress));
    server.on("model", (model) => this.#take(model));
    server.on("failed", (failed) => this.#failed(failed));
    const notice = new ConnectionNotice(server);
    document.body.append(notice.element);
    server.onConnection = (connection) => {
      notice.show(connection);
      if (connection === "open") return;
      this.#begun(null);
      if (!this.#mesh) this.#reading.lose();
    };
    for (const type of ["input", "change"])
      document.getElementById("panel")!.addEventListener(type, () => this.#keepSoon());
    window.addEventListener("pagehide", () => this.#keep());
  }

  /** Starts choosing handles on the body of the server's own model. */
  edit(): void {
    void this.#try(() => void this.#server.send({ type: "edit" }));
  }

  /** Opens another mesh from a file. */
  upload(file: File): void {
    if (this.#given) void this.#reading.upload(file, this.#given);
  }

  async #enter(given: Given): Promise<void> {
    const before = this.#given;
    this.#given = given;
    if (given.kind === "model") return; // the page has shown it
    if (this.#mesh && before?.id !== given.id) {
      this.#isBack = true; // the connection was lost; what was chosen here stays
      if (given.kind === "empty") this.#panel.fault("The server no longer has the mesh. Drop it here again.");
    }
    if (given.kind !== "mesh" || given.mesh === null) {
      if (!this.#isBack) this.#await(given);
      return;
    }
    const isSame = this.#mesh?.name === given.name && this.#mesh.diagonal === given.diagonal;
    const isThere = this.#mesh !== null && before?.id === given.id && before.mesh === given.mesh;
    if (isThere) {
      this.#isRunning = given.is_running ?? false; // the newest model and the progress follow
      this.#update();
      return;
    }
    if (this.#isBack && isSame) {
      if (this.#isRunning) this.#panel.fault("The server no longer has the computation. Compute again.");
      [this.#isBack, this.#isRunning] = [false, false];
      this.#update();
      this.#keep();
      return;
    }
    this.#isBack = false;
    this.#mesh = readMesh(await this.#server.fetched(given.mesh));
    [this.#choice, this.#sampling] = [choiceOf(given.handles, given.parts), samplingOf(given)];
    [this.#model, this.#job, this.#isRunning] = [null, given.job ?? 0, given.is_running ?? false];
    this.#motions = motionsOf(location.hash); // after a reload
    this.#panel.clear();
    this.#check?.dispose();
    this.#check = given.has_surface ? new CheckPanel(this.#shell.stage, this.#server) : null;
    this.#choosing(true);
  }

  /** Shows that there is no mesh: asks for one, or waits for it. */
  #await(given: Given): void {
    [this.#mesh, this.#posing] = [null, null];
    this.#shell.empty();
    if (given.kind === "empty") this.#reading.ask(given);
    else this.#reading.wait(given);
  }

  /** The view in which handles are chosen. */
  #choosing(isNew = false): void {
    const [stage, mesh] = [this.#shell.stage, this.#mesh!];
    this.#leave();
    const below = [...(this.#check?.elements ?? []), this.#panel.element];
    const onChoice = (choice: Choice) => {
      if (choice.handles !== this.#choice.handles || choice.parts !== this.#choice.parts) this.#panel.clear();
      this.#choice = choice;
      this.#update();
      this.#keepSoon();
    };
    const { up } = isNew ? this.#shell.options(mesh.up) : stage;
    this.#shell.show(
      choosingView(
        stage,
        mesh,
        this.#choice,
        this.#sampling!,
        this.#given!,
        below,
        this.#server,
        onChoice,
        () => this.#keepSoon(),
        { up, forceCpu: true, keepView: !isNew },
      ),
      mesh.name,
    );
    this.#check?.show();
    this.#update();
  }

  #backToChoosing(): void {
    this.#choosing();
    keepHash(() => CHOOSING);
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

  /** The view in which the newest model is posed. */
  async #pose(): Promise<void> {
    const { stage, module } = this.#shell;
    const { content } = this.#model!;
    this.#leave();
    const polish = polishAt(this.#server, () => this.#model!.sent.number);
    const motions = this.#motions;
    const options = { ...this.#shell.options(stage.up), up: stage.up, keepView: true, polish, motions };
    const view = await posingView(stage, await module, content, options);
    this.#posing = view;
    this.#shell.show({ ...view, panel: [this.#panel.element, ...view.panel] }, content.name);
    this.#update();
  }

  #leave(): void {
    if (this.#posing) this.#motions = this.#posing.motions;
    this.#posing = null;
    this.#check?.hide();
    this.#shell.clear();
  }

  async #compute(): Promise<void> {
    if (!this.#panel.isValid()) return;
    await this.#sendChoice();
    const { translation: _, angle: __, ...wanted } = this.#sampling!;
    this.#panel.clear();
    [this.#model, this.#staysChoosing] = [null, false];
    this.#motions = new Map(); // they are of the handles before
    keepHash(() => "");
    this.#keep();
    [this.#job, this.#isRunning] = [this.#server.send({ type: "compute", ...wanted }), true];
    this.#panel.begin();
    this.#update();
  }

  async #sendChoice(): Promise<void> {
    const { translation, angle } = this.#sampling!;
    const [handles, parts] = [orderedHandleMessages(this.#choice.handles), partMessages(this.#choice.parts)];
    await this.#server.ask({ type: "choose", handles, translation, angle, parts }, "chosen");
  }

  async #cancel(): Promise<void> {
    await this.#server.ask({ type: "cancel" }, "cancelled");
    this.#isRunning = false;
    this.#update();
  }

  async #save(): Promise<void> {
    if (this.#posing === null) await this.#sendChoice();
    const [up, timeline] = [this.#shell.stage.up, this.#posing?.timeline ?? null];
    const { message } = await this.#server.ask({ type: "save", name: null, up, timeline }, "saved");
    this.#panel.saved(message, this.#given!.folder);
  }

  #progress(progress: Progress): void {
    if (progress.request === 0) this.#reading.progress(progress);
    else if (progress.request === this.#job && this.#isRunning) this.#panel.progress(progress);
  }

  #take(sent: Model): void {
    this.#models.announce(sent);
    this.#later(() => this.#show(sent));
  }

  #later(act: () => Promise<void>): void {
    this.#queue = this.#queue.then(() => this.#try(act));
  }

  /** Takes a better model, or the first one, which is posed at once. */
  async #show(sent: Model): Promise<void> {
    if (sent.request !== this.#job || sent.number === this.#model?.sent.number) return;
    const content = await this.#models.read(sent, this.#server, this.#mesh!.name);
    if (!content || sent.request !== this.#job) return;
    const isFirst = this.#model === null;
    // set after posing has the model, because polishing uses its number
    await this.#posing?.replace(content);
    this.#model = { sent, content };
    this.#isRunning &&= !sent.final;
    this.#panel.model(sent);
    if (isFirst && !this.#staysChoosing) await this.#pose();
    this.#update();
  }

  #failed({ request, message }: Failed): void {
    if (request === 0) return this.#reading.failed(message);
    if (request !== this.#job) return;
    this.#isRunning = false;
    this.#panel.fault(message);
    this.#update();
  }

  #update(): void {
    this.#panel.update({
      isChoosing: this.#posing === null,
      lacking: lacking(this.#choice),
      isRunning: this.#isRunning,
      hasModel: this.#model !== null,
    });
  }

  async #try(act: () => Promise<void> | void): Promise<void> {
    try {
      await act();
    } catch (error) {
      if (error instanceof Refused) this.#panel.fault(error.message);
      else this.#shell.showMessage(readable(error), true);
    }
  }
}

const KEEP_PAUSE = 150; // milliseconds: a brush changes the choice with every move
