import type { Model, Progress, Saved } from "../engine/messages.ts";
import { h, section, setText } from "./dom.ts";

const STAGES: Record<string, string> = {
  waiting: "Waiting for another computation",
  reading: "Reading the mesh",
  filling: "Filling the surface with tets",
  "filling inside": "Finding the inside of the surface",
  "filling boundary": "Fitting tets to the surface",
  "filling exactly": "Filling the surface exactly (up to some minutes)",
  snapshots: "Solving samples",
  subspace: "Finding the subspace",
  energy: "Reducing the energy",
};

export interface ComputeActions {
  compute(): void;
  cancel(): void;
  save(): void;
  exportPage(): void;
  choose(): void;
  show(): void;
}

/** The Compute button, its progress and its result. One panel serves all views, from choosing to posing. */
export class ComputePanel {
  readonly element: HTMLElement;
  readonly #compute: HTMLButtonElement;
  readonly #cancel: HTMLButtonElement;
  readonly #save: HTMLButtonElement;
  readonly #export: HTMLButtonElement;
  readonly #choose: HTMLButtonElement;
  readonly #show: HTMLButtonElement;
  readonly #bar = new ProgressBar();
  #newest: Model | null = null;
  readonly #model = h("p", { className: "model", role: "status", hidden: true });
  readonly #savedText = h("p", { className: "saved", role: "status", hidden: true });
  readonly #fault = h("p", { className: "fault", role: "alert", hidden: true });

  constructor(acts: ComputeActions) {
    const button = (label: string, act: () => void, className = "") =>
      h("button", { type: "button", className, onclick: act }, label);
    this.#compute = button("Compute", acts.compute, "primary");
    this.#compute.setAttribute("aria-describedby", "lacking");
    this.#cancel = button("Cancel", acts.cancel);
    this.#save = button("Save", acts.save);
    this.#export = button("Export HTML", acts.exportPage);
    this.#export.title = "A page in one file, which needs no server";
    this.#choose = button("Choose handles", acts.choose);
    this.#show = button("Pose", acts.show);
    this.element = section(
      "Model",
      this.#bar.element,
      this.#model,
      this.#fault,
      this.#savedText,
      h(
        "div",
        { className: "row acts" },
        this.#compute,
        this.#cancel,
        this.#choose,
        this.#show,
        this.#save,
        this.#export,
      ),
    );
  }

  /** Shows what can be done now. */
  update(now: {
    isChoosing: boolean;
    lacking: string;
    isRunning: boolean;
    /** Whether there is a server: without it nothing is known of a computation, and nothing can stop it. */
    isConnected: boolean;
    /** The kind of the model that there is. */
    model: "posing" | "interpolation" | null;
    /** Whether the view has its own button that leads to the handles. */
    hasChooser: boolean;
  }): void {
    const isSeen = now.isRunning && now.isConnected;
    this.#compute.hidden = !now.isChoosing || now.isRunning;
    this.#compute.disabled = now.lacking !== "";
    this.#cancel.hidden = !isSeen;
    this.#choose.hidden = now.isChoosing || now.hasChooser;
    this.#show.hidden = !now.isChoosing || now.model === null;
    this.#show.textContent = now.model === "interpolation" ? "Blend" : "Pose";
    this.element.classList.toggle("stays", now.isChoosing);
    this.#compute.title = now.lacking;
    const isPosed = now.model === "posing"; // only such a model is of handles
    this.#save.textContent = isPosed ? "Save" : "Save handles";
    this.#showModel(isSeen);
    this.#save.hidden = now.lacking !== "" || (!now.isChoosing && !isPosed);
    this.#export.hidden = now.model === null;
    if (!isSeen) this.#bar.element.hidden = true;
  }

  /** Whether all numbers in the panel are valid; shows the first one that is not. */
  isValid(): boolean {
    const wrong = this.element.parentElement?.querySelector<HTMLInputElement>("input:invalid");
    const folded = wrong?.closest("details");
    if (folded) folded.open = true;
    const hidden = wrong?.closest("[hidden]");
    if (hidden) document.querySelector<HTMLElement>(`[aria-controls="${hidden.id}"]`)?.click();
    return wrong?.reportValidity() ?? true;
  }

  /** Clears all texts. */
  clear(): void {
    this.#newest = null;
    for (const text of [this.#model, this.#savedText, this.#fault]) text.hidden = true;
  }

  /** Shows that a computation begins. */
  begin(): void {
    this.#bar.show({ stage: "snapshots", done: 0, total: 0, eta: null, error: null });
  }

  progress(progress: Progress): void {
    this.#bar.show(progress);
  }

  model(model: Model): void {
    this.#newest = model;
  }

  #showModel(isRunning: boolean): void {
    this.#model.hidden = this.#newest === null;
    if (!this.#newest) return;
    const { samples, dimension, error, final, seconds } = this.#newest;
    const parts = [`${samples} samples`, `${dimension} dimensions`];
    if (error !== null) parts.push(`error of unseen motions ${percent(error)}`);
    const ready = isRunning ? "Ready to pose, and improving" : "Ready to pose";
    const head = final && !isRunning ? `Done in ${duration(seconds)}` : ready;
    setText(this.#model, `${head}: ${parts.join(", ")}.`);
  }

  saved({ problem, model, mesh, surface }: Saved, folder: string): void {
    const names = [problem, model, mesh, surface]
      .filter((path) => path !== null)
      .map((path) => path.replace(/^.*[\\/]/, ""));
    this.#savedText.textContent = `Saved ${names.join(", ")} in ${folder}.`;
    this.#savedText.hidden = false;
  }

  get hasFault(): boolean {
    return !this.#fault.hidden;
  }

  /** Shows what is wrong, as a sentence; nothing for an empty text. */
  fault(text: string): void {
    this.#fault.textContent = text.charAt(0).toUpperCase() + text.slice(1);
    this.#fault.hidden = text === "";
  }
}

/** A progress bar with a text below it. */
export class ProgressBar {
  readonly element: HTMLElement;
  readonly #bar = h("progress", { "aria-label": "Progress" });
  readonly #stage = h("span", {});
  readonly #figures = h("span", { className: "detail" });

  constructor() {
    const words = h("p", { className: "progress-words" }, this.#stage, this.#figures);
    this.element = h("div", { className: "progress", hidden: true }, this.#bar, words);
  }

  show({
    stage,
    done,
    total,
    eta,
    error,
  }: Pick<Progress, "stage" | "done" | "total" | "eta" | "error">): void {
    this.element.hidden = false;
    const isWaiting = stage === "waiting"; // then total counts the computations that come first
    if (total > 0 && !isWaiting) {
      this.#bar.max = total;
      this.#bar.value = done;
    } else this.#bar.removeAttribute("value");
    const text = STAGES[stage] ?? stage;
    if (this.#stage.textContent !== text) this.#stage.textContent = text;
    const parts = [];
    if (isWaiting && total > 1) parts.push(`${total.toLocaleString("en")} come first`);
    if (total === 0 && done > 0) parts.push(`pass ${done}`);
    if (total > 0 && !isWaiting) parts.push(`${done.toLocaleString("en")} of ${total.toLocaleString("en")}`);
    if (eta !== null) parts.push(`${duration(eta)} left`);
    if (error !== null) parts.push(`error ${percent(error)}`);
    this.#figures.textContent = parts.join(" · ");
  }
}

function percent(share: number): string {
  return `${Number((100 * share).toPrecision(2))}\u00a0%`;
}

function duration(seconds: number): string {
  if (seconds < 90) return `${seconds < 10 ? seconds.toFixed(1) : Math.round(seconds)} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}
