import { readModel, UnreadableModel } from "../engine/index.ts";
import { blendingView } from "./blending_view.ts";
import { coreBytes } from "./core_bytes.ts";
import { h } from "./dom.ts";
import { posingView } from "./posing_view.ts";
import { fromFile, ownModel, type Source } from "./source.ts";
import { Stage, type Axis } from "./stage.ts";
import { followTheme } from "./theme.ts";
import type { View } from "./view.ts";
import "./panel.css";
import "./style.css";

/** For scripts and tests: what the view shows, and a promise that is kept when a model is. */
declare global {
  interface Window {
    snapspace: Record<string, unknown>;
  }
}

const started = performance.now();
const room = document.getElementById("stage")!;
const message = document.getElementById("message")!;
const panel = document.getElementById("panel")!;
const fold = document.getElementById("fold")!;
const query = new URLSearchParams(location.search);
let stage: Stage | null = null;
let view: View | null = null;

/** Shows a model in place of the one before; a message if it cannot be read, and the one before stays. */
async function open(source: () => Promise<Source | null>): Promise<void> {
  try {
    const given = await source();
    if (!given) {
      tell("Drop a .snapspace file here, or open one.", false);
      return;
    }
    const arrived = performance.now();
    const model = readModel(given.bytes, given.name);
    const module = await WebAssembly.compile(coreBytes());
    stage ??= newStage();
    view?.dispose();
    view = null;
    clear();
    const options = {
      up: (query.get("up") ?? model.up ?? "z") as Axis,
      forceCpu: query.get("deform") === "cpu",
    };
    const make =
      model.kind === "posing"
        ? posingView(stage, module, model, options)
        : blendingView(stage, module, model, options);
    view = await make;
    fold.after(...view.panel);
    room.append(view.hud.element, view.hud.notice);
    message.hidden = true;
    panel.hidden = false;
    document.title = model.name || "Snapspace";
    stage.renderer.render(stage.scene, stage.camera);
    stage.draw();
    const now = performance.now();
    window.snapspace = {
      ...view.script,
      ready: true,
      openedIn: now - arrived,
      startedIn: now - started,
      stage,
    };
  } catch (error) {
    tell(readable(error), true);
  }
}

function newStage(): Stage {
  try {
    const made = new Stage(document.querySelector("canvas")!);
    followTheme((dark) => (made.dark = dark));
    return made;
  } catch {
    throw new UnreadableModel("This browser has no WebGL 2, which the page needs to draw.");
  }
}

function readable(error: unknown): string {
  if (error instanceof UnreadableModel) return error.message;
  if (error instanceof WebAssembly.CompileError)
    return "This browser is too old: it lacks WebAssembly with SIMD.";
  console.error(error);
  return `The page has a fault: ${String(error)}`;
}

function tell(text: string, isError: boolean): void {
  message.replaceChildren(h("p", { role: isError ? "alert" : "status" }, text), opener());
  message.classList.toggle("error", isError);
  message.hidden = false;
  window.snapspace = { ...window.snapspace, message: text };
}

function clear(): void {
  panel.querySelectorAll("section").forEach((part) => part.remove());
  room.querySelectorAll(".hud, .notice").forEach((part) => part.remove());
}

/** A button that asks for a file. */
function opener(): HTMLElement {
  const input = h("input", { type: "file", accept: ".snapspace", hidden: true });
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    if (file) void open(() => fromFile(file));
  });
  return h("div", {}, h("button", { type: "button", onclick: () => input.click() }, "Open a model…"), input);
}

document.addEventListener("dragover", (event) => event.preventDefault());
document.addEventListener("drop", (event) => {
  event.preventDefault();
  const file = event.dataTransfer?.files[0];
  if (file) void open(() => fromFile(file));
});
fold.addEventListener("click", (event) => {
  const folded = document.body.classList.toggle("folded");
  (event.currentTarget as HTMLElement).setAttribute("aria-expanded", String(!folded));
});
panel.append(h("footer", {}, opener()));
window.snapspace = {};
void open(ownModel);
