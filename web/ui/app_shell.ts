import { UnreadableModel } from "../engine/index.ts";
import { AxisWidget } from "./axis_widget.ts";
import { compiledCore } from "./core_bytes.ts";
import { h } from "./dom.ts";
import { isAxis, Stage, type Axis } from "./stage.ts";
import { followTheme } from "./theme.ts";
import type { View, ViewOptions } from "./view.ts";

/** The page's fixed parts: the stage, the panel, and the message above them. It shows one view at a time. */
export class AppShell {
  readonly #main = document.getElementById("stage")!;
  readonly #panel = document.getElementById("panel")!;
  readonly #message = document.getElementById("message")!;
  readonly #query = new URLSearchParams(location.search);
  #isDark = false;
  #stage: Stage | null = null;
  #module: Promise<WebAssembly.Module> | null = null;
  #view: View | null = null;

  constructor() {
    followTheme((dark) => {
      this.#isDark = dark;
      if (this.#stage) this.#stage.dark = dark;
    });
  }

  /** The stage, made on first use. Throws UnreadableModel if the browser cannot draw. */
  get stage(): Stage {
    if (!this.#stage) {
      this.#stage = newStage();
      this.#stage.dark = this.#isDark;
      const axes = new AxisWidget(this.#stage);
      this.#stage.drawn = () => axes.update();
      this.#main.append(axes.element);
    }
    return this.#stage;
  }

  /** The core, compiled. */
  get module(): Promise<WebAssembly.Module> {
    this.#module ??= compiledCore();
    return this.#module;
  }

  /** Options from the page's address. */
  options(up: Axis | undefined): ViewOptions {
    const asked = this.#query.get("up");
    return {
      up: isAxis(asked) ? asked : (up ?? "z"),
      forceCpu: this.#query.get("deform") === "cpu",
    };
  }

  /** Removes the present view, before another one is made. */
  clear(): void {
    this.#view?.dispose();
    this.#view = null;
    this.#panel.querySelectorAll("section").forEach((part) => part.remove());
    this.#main.querySelectorAll(".hud, .notice").forEach((part) => part.remove());
  }

  /** Removes the present view and hides the panel. */
  empty(): void {
    this.clear();
    this.#panel.hidden = true;
  }

  show(view: View, title: string, script: Record<string, unknown> = {}): void {
    this.#view = view;
    document.getElementById("fold")!.after(...view.panel);
    this.#main.append(view.hud.element, view.hud.notice);
    this.quiet();
    this.#panel.hidden = false;
    this.#panel.scrollTop = 0;
    document.title = title || "Snapspace";
    const { renderer, scene } = this.stage;
    renderer.canvas.setAttribute("aria-label", view.label);
    this.stage.fit(); // the panel takes some of its place: already in the first picture
    this.stage.drawNow();
    renderer.prepare(scene); // hidden parts as well, such as the gizmo: the first press should not wait
    // inherited, not copied: what the view reports changes while it is shown
    window.snapspace = Object.assign(Object.create(view.script), {
      ready: true,
      stage: this.stage,
      ...script,
    });
  }

  /** Hides the message. */
  quiet(): void {
    this.#message.hidden = true;
  }

  /** Whether the message is below what the stage shows, until the next one. */
  set messageBelow(isBelow: boolean) {
    this.#message.classList.toggle("below", isBelow);
  }

  /** Shows a message above everything, with elements below it that help. */
  showMessage(text: string, isError: boolean, ...below: HTMLElement[]): void {
    const words = h("p", { role: isError ? "alert" : "status" }, text);
    const row = h("div", { className: "row" }, ...below);
    if (isError && this.#view)
      row.append(h("button", { type: "button", onclick: () => this.quiet() }, "Close"));
    this.#message.replaceChildren(words, row);
    this.#message.classList.toggle("error", isError);
    this.messageBelow = false;
    this.#message.hidden = false;
    window.snapspace["message"] = text;
  }
}

function newStage(): Stage {
  try {
    return new Stage(document.querySelector("canvas")!);
  } catch {
    throw new UnreadableModel("This browser has no WebGL 2, which the page needs to draw.");
  }
}

/** An error as a text for the user. */
export function readable(error: unknown): string {
  if (error instanceof UnreadableModel) return error.message;
  if (error instanceof WebAssembly.CompileError)
    return "This browser is too old: it lacks WebAssembly with SIMD.";
  console.error(error);
  return `Something went wrong in the page: ${String(error)}`;
}
