import { readModel, UnreadableModel } from "../engine/index.ts";
import { compiledCore } from "../ui/core_bytes.ts";
import { h } from "../ui/dom.ts";
import { png } from "../ui/picture.ts";
import { nameOf } from "../ui/source.ts";
import { Stage, type Axis } from "../ui/stage.ts";
import type { HandleMotion, ModelInfo, SnapspaceViewerElement } from "./public.ts";
import { shownBlending } from "./shown_blending.ts";
import type { ShownModel } from "./shown_model.ts";
import { shownPosing } from "./shown_posing.ts";
import { STYLE } from "./style.ts";

const AXES = ["x", "y", "z"];

let core: Promise<WebAssembly.Module> | null = null;
/** The core, compiled once for all elements of a page. */
const compiled = () => (core ??= compiledCore());

/** The custom element <snapspace-viewer>; see public.ts for what its members do. */
export class SnapspaceViewer extends HTMLElement implements SnapspaceViewerElement {
  static readonly observedAttributes = ["src", "poster", "controls", "up"];
  readonly #place = h("div", { className: "stage" });
  readonly #poster = h("img", { className: "poster", alt: "", hidden: true });
  readonly #bar = h("div", { className: "bar", role: "group", "aria-label": "Controls", hidden: true });
  readonly #message = h("p", { className: "message", role: "alert", hidden: true });
  #stage: Stage | null = null;
  #shown: ShownModel | null = null;
  /** The shape at rest, and the axis that points up. */
  #base: { shape: Float32Array; up: Axis | undefined } | null = null;
  /** What is loaded now: an earlier load that ends later has no effect. */
  #loading = 0;

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    root.append(h("style", {}, STYLE), this.#place, this.#poster, this.#bar, this.#message);
    this.#newCanvas();
  }

  connectedCallback(): void {
    if (this.src && !this.#shown) void this.#fetch(this.src);
  }

  /** Frees the graphics; an element that is moved in the page loads its model again. */
  disconnectedCallback(): void {
    queueMicrotask(() => {
      if (this.isConnected) return; // it was moved
      this.#loading++;
      this.#clear();
      this.#stage?.dispose();
      this.#stage = null;
      this.#newCanvas(); // the old one's graphics are gone
    });
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (before === now) return;
    if (name === "src" && this.isConnected && now) void this.#fetch(now);
    else if (name === "controls") this.#showBar();
    else if (name === "up" && this.#shown) this.#stand();
    else if (name === "poster") {
      this.#poster.hidden = !now || this.#shown !== null;
      if (now) this.#poster.src = now;
    }
  }

  get src(): string {
    return this.getAttribute("src") ?? "";
  }
  set src(address: string) {
    this.setAttribute("src", address);
  }
  get poster(): string {
    return this.getAttribute("poster") ?? "";
  }
  set poster(address: string) {
    this.setAttribute("poster", address);
  }
  get controls(): boolean {
    return this.hasAttribute("controls");
  }
  set controls(on: boolean) {
    this.toggleAttribute("controls", on);
  }
  get up(): string {
    return this.getAttribute("up") ?? "";
  }
  set up(axis: string) {
    this.setAttribute("up", axis);
  }
  get model(): ModelInfo | null {
    return this.#shown?.info ?? null;
  }
  get handles(): Record<string, Required<HandleMotion>> {
    return this.#shown?.handles ?? {};
  }
  get weights(): Record<string, number> {
    return this.#shown?.weights ?? {};
  }
  get isPlaying(): boolean {
    return this.#shown?.isPlaying ?? false;
  }

  setHandles(motions: Readonly<Record<string, HandleMotion>>): void {
    this.#model.setHandles(motions);
  }
  setWeights(weights: Readonly<Record<string, number>>): void {
    this.#model.setWeights(weights);
  }
  reset(): void {
    this.#model.reset();
  }
  play(): void {
    this.#model.play(true);
  }
  pause(): void {
    this.#model.play(false);
  }
  shape(): { positions: Float32Array; faces: Uint32Array } {
    return { positions: this.#model.shape(), faces: this.#model.faces };
  }

  async picture(width: number, height: number): Promise<Blob> {
    this.#model.shape(); // solves for what was asked
    const show = this.#model.bare();
    try {
      return await png(this.#stage!, { width, height }, null);
    } finally {
      show();
    }
  }

  async load(bytes: ArrayBuffer, name = ""): Promise<ModelInfo> {
    return this.#show(++this.#loading, async () => ({ bytes, name }));
  }

  async #fetch(address: string): Promise<void> {
    await this.#show(++this.#loading, () => fetched(address, this.baseURI)).catch(() => {}); // it was told by an event
  }

  async #show(
    number: number,
    source: () => Promise<{ bytes: ArrayBuffer; name: string }>,
  ): Promise<ModelInfo> {
    try {
      const { bytes, name } = await source();
      const [model, module] = [readModel(bytes, name), await compiled()];
      if (number !== this.#loading) throw new SupersededLoad();
      this.#clear();
      const stage = (this.#stage ??= new Stage(this.#canvas));
      const shown =
        model.kind === "posing"
          ? await shownPosing(stage, module, model)
          : await shownBlending(stage, module, model);
      if (number !== this.#loading) {
        shown.dispose();
        throw new SupersededLoad();
      }
      this.#shown = shown;
      shown.onSolved = (detail) => this.dispatchEvent(new CustomEvent("solve", { detail }));
      this.#base = { shape: model.space.base, up: model.up };
      this.#stand();
      this.#poster.hidden = this.#message.hidden = true;
      this.#canvas.setAttribute("aria-label", model.name || "The shape");
      this.#showBar();
      this.dispatchEvent(new CustomEvent("load", { detail: shown.info }));
      return shown.info;
    } catch (error) {
      if (!(error instanceof SupersededLoad)) this.#fail(error);
      throw error;
    }
  }

  #newCanvas(): void {
    const canvas = h("canvas", { tabIndex: 0, role: "img", "aria-label": "The shape" });
    canvas.addEventListener("keydown", (event) => this.#shown?.key(event));
    this.#place.replaceChildren(canvas);
  }

  get #canvas(): HTMLCanvasElement {
    return this.#place.querySelector("canvas")!;
  }

  /** Puts the shape on the ground. */
  #stand(): void {
    const { shape, up } = this.#base!;
    this.#stage!.place(shape, AXES.includes(this.up) ? (this.up as Axis) : (up ?? "z"));
  }

  #showBar(): void {
    const visible = this.controls && this.#shown !== null;
    this.#bar.hidden = !visible;
    this.#bar.replaceChildren(...(visible ? this.#shown!.controls() : []));
  }

  #fail(error: unknown): void {
    const message = error instanceof Error ? error.message : String(error);
    this.#message.textContent = message;
    this.#message.hidden = false;
    this.dispatchEvent(new CustomEvent("error", { detail: { message } }));
  }

  #clear(): void {
    this.#shown?.dispose();
    this.#shown = null;
    this.#showBar();
  }

  get #model(): ShownModel {
    if (!this.#shown) throw new Error("snapspace-viewer: there is no model yet; wait for its event 'load'.");
    return this.#shown;
  }
}

/** Another model was asked for meanwhile. */
class SupersededLoad extends Error {
  constructor() {
    super("snapspace-viewer: another model was loaded meanwhile.");
  }
}

async function fetched(address: string, base: string): Promise<{ bytes: ArrayBuffer; name: string }> {
  const url = new URL(address, base);
  const answer = await fetch(url).catch(() => null);
  if (!answer?.ok)
    throw new UnreadableModel(
      `There is no model at ${url.href} (${answer ? `status ${answer.status}` : "no answer"}).`,
    );
  const name = decodeURIComponent(nameOf(url.pathname));
  return { bytes: await answer.arrayBuffer(), name };
}

if (!customElements.get("snapspace-viewer")) customElements.define("snapspace-viewer", SnapspaceViewer);
