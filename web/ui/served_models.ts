import type { BlendingModel, PosingModel } from "../engine/index.ts";
import type { HandleChoice, KeptPoint, Model, Progress } from "../engine/messages.ts";
import type { AppShell } from "./app_shell.ts";
import { blendingView } from "./blending_view.ts";
import { ComputePanel } from "./compute_panel.ts";
import { exportPage } from "./export_page.ts";
import { Improving } from "./improving.ts";
import { PageJob } from "./page_job.ts";
import { polishAt } from "./polishing.ts";
import { posingView, type PosingView } from "./posing_view.ts";
import { SentModels } from "./sent_models.ts";
import type { Request, Server } from "./server.ts";
import type { View, ViewState } from "./view.ts";

/** The body and the handles that models are made for. */
export interface Chosen {
  readonly name: string;
  /** Where the server saves. */
  readonly folder: string;
  /** What must still be chosen before a model can be computed; empty if nothing. */
  readonly lacking: string;
  /** Whether handles are chosen although there is a model. */
  readonly staysChoosing: boolean;
  compute(): Promise<void>;
  /** Goes back to the view in which handles are chosen. */
  choose(): void;
  /** Leaves the view that is shown, before another one. */
  leave(): void;
  /** Sends the choice to the server. */
  send(): Promise<void>;
  /** Adds points that have become handles. */
  add(kept: readonly HandleChoice[]): void;
  /** Does something and shows its error, if there is one. */
  try(act: () => Promise<void> | void): Promise<void>;
}

/** A model at the server: its number, and what the page shows of it. */
interface ServedModel {
  readonly number: number;
  readonly content: PosingModel | BlendingModel;
}

/** Models that the server computes or has, and the page poses or blends: the newest one is shown, saved and exported. */
export class ServedModels {
  readonly panel: ComputePanel;
  readonly job = new PageJob();
  /** Makes handles of points that are kept. */
  readonly improving: Improving;
  /** The state in which the model was left. */
  state: ViewState = {};
  readonly #shell: AppShell;
  readonly #server: Server;
  readonly #chosen: Chosen;
  readonly #sent = new SentModels();
  /** The newest model. */
  #model: ServedModel | null = null;
  /** The one before a computation, until there is a model of that. */
  #before: ServedModel | null = null;
  /** The view of the model; a blend is never replaced. */
  #view: (View & Partial<Pick<PosingView, "replace">>) | null = null;
  /** Whether the view is that of the server's own model. */
  #isOwn = false;

  constructor(shell: AppShell, server: Server, chosen: Chosen) {
    [this.#shell, this.#server, this.#chosen] = [shell, server, chosen];
    const acts = {
      compute: () => chosen.compute(),
      cancel: () => this.#cancel(),
      save: () => this.#save(),
      exportPage: () => this.#export(),
      choose: () => chosen.choose(),
      show: () => this.#show(),
    };
    const tried = Object.entries(acts).map(([name, act]) => [name, () => void chosen.try(act)]);
    this.panel = new ComputePanel(Object.fromEntries(tried));
    this.improving = new Improving({
      order: (points) => void chosen.try(() => this.#extend(points)),
      cancel: () => void chosen.try(() => this.#cancel()),
    });
  }

  /** The number of the model that is shown, at the server. */
  get number(): number {
    return this.#model?.number ?? 0;
  }

  get isPosing(): boolean {
    return this.#view !== null;
  }

  /** Adopts the server's own model, which the page poses. */
  adopt(content: PosingModel, view: PosingView): View {
    [this.#model, this.#view, this.#isOwn] = [{ number: 0, content }, view, true];
    this.update();
    return { ...view, panel: [this.panel.element, ...view.panel] };
  }

  /** Forgets the models of another body. */
  clear(): void {
    this.#model = this.#before = null;
    this.panel.clear();
  }

  /** Before another view. */
  leave(): void {
    this.state = this.#view?.state ?? this.state;
    [this.#view, this.#isOwn] = [null, false];
    this.improving.forget();
  }

  /** Asks the server for models. Refused without a connection. */
  order(request: Request): void {
    this.job.order(this.#server.send(request));
    if (request.type === "compute") this.#begin();
    this.panel.begin();
    this.update();
  }

  /** Prepares for models of other handles: the present model comes back if none of them arrives. */
  #begin(): void {
    this.#before = this.#model ?? this.#before;
    this.#model = null;
    // motions are of the handles before, and keys of a blend or of another body do not fit
    this.state = this.#before?.content.kind === "posing" ? { timeline: this.state.timeline } : {};
    this.panel.clear();
  }

  #restore(): void {
    this.#model ??= this.#before;
  }

  progress(progress: Progress): void {
    const isKnown = this.job.takes(progress.request) && this.job.isRunning;
    if (isKnown && this.#server.isOpen) this.panel.progress(progress);
  }

  announce(sent: Model): void {
    this.#sent.announce(sent);
  }

  /** Receives a better model, or the first one, which is posed at once. */
  async take(sent: Model): Promise<void> {
    if (!this.job.takes(sent.request) || sent.number === this.#model?.number) return;
    const content = await this.#sent.read(sent, this.#server, this.#chosen.name);
    if (!content || !this.job.takes(sent.request)) return;
    const isFirst = this.#model === null;
    if (sent.kept?.length) this.improving.arrived();
    // set after posing has the model, because polishing uses its number
    if (content.kind === "posing") await this.#view?.replace?.(content);
    this.#model = { number: sent.number, content };
    this.#chosen.add(sent.kept ?? []);
    if (sent.request) this.panel.model(sent); // others were not computed here
    if (sent.final) this.job.end(sent.request);
    if (isFirst && !this.#chosen.staysChoosing) await this.#show();
    this.update();
  }

  /** Whether the failed request was for models. */
  fails(request: number, message: string): void {
    if (!this.job.fails(request)) return;
    this.#restore();
    this.panel.fault(message);
    this.improving.failed();
    this.update();
  }

  update(): void {
    this.panel.update({
      isChoosing: this.#view === null,
      lacking: this.#chosen.lacking,
      isRunning: this.job.isRunning,
      isConnected: this.#server.isOpen,
      model: this.#model?.content.kind ?? null,
      hasChooser: this.#isOwn,
    });
    // nothing is there to be saved before the server's own model is improved
    const isAsOpened = this.#isOwn && this.number === 0 && !this.job.isRunning;
    this.panel.element.hidden = isAsOpened && !this.panel.hasFault;
  }

  /** The view in which the newest model is posed or blended. */
  async #show(): Promise<void> {
    const { stage } = this.#shell;
    const { content } = this.#model!;
    this.#chosen.leave();
    const module = await this.#shell.module;
    const polish = polishAt(this.#server, () => this.number);
    const { state, improving } = this;
    const options = {
      ...this.#shell.options(stage.up),
      up: stage.up,
      keepView: true,
      ...state,
      polish,
      improving,
    };
    const view =
      content.kind === "posing"
        ? await posingView(stage, module, content, options)
        : await blendingView(stage, module, content, options);
    this.#view = view;
    this.#shell.show({ ...view, panel: [this.panel.element, ...view.panel] }, content.name);
    this.update();
  }

  #extend(points: readonly KeptPoint[]): void {
    this.panel.fault("");
    try {
      this.order({ type: "extend", points });
    } catch (error) {
      this.improving.cancelled();
      throw error;
    }
  }

  async #cancel(): Promise<void> {
    const { request } = this.job;
    await this.#server.ask({ type: "cancel" }, "cancelled");
    if (request !== this.job.request) return; // another one has begun since
    this.job.end(request);
    this.#restore();
    this.improving.cancelled();
    this.update();
  }

  async #save(): Promise<void> {
    if (!this.isPosing) await this.#chosen.send();
    const [{ up }, timeline] = [this.#shell.stage, this.#keys];
    const { message } = await this.#server.ask({ type: "save", name: null, up, timeline }, "saved");
    this.panel.saved(message, this.#chosen.folder);
  }

  async #export(): Promise<void> {
    const { number, content } = this.#model!;
    const { up } = this.#shell.stage;
    await exportPage(this.#server, { model: number, name: content.name, up, timeline: this.#keys });
  }

  /** The keys that were made on the page, also while another view is shown. */
  get #keys(): string | null {
    return (this.#view?.state ?? this.state).timeline ?? null;
  }
}
