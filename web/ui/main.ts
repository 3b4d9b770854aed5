import { readModel } from "../engine/index.ts";
import { blendOf, motionsOf } from "./address.ts";
import { blendingView } from "./blending_view.ts";
import { filePicker, h } from "./dom.ts";
import { polishAt } from "./polishing.ts";
import { posingView } from "./posing_view.ts";
import { readable, AppShell } from "./app_shell.ts";
import { Server } from "./server.ts";
import { fromFile, ownModel, type Source } from "./source.ts";
import { Workspace } from "./workspace.ts";
import "./panel.css";
import "./style.css";
import "./blending.css";
import "./workspace.css";
import "./choosing.css";
import "./access.css";

/** For scripts and tests: what the view shows. */
declare global {
  interface Window {
    snapspace: Record<string, unknown>;
  }
}

const started = performance.now();
window.snapspace = {};
document.getElementById("panel")!.append(h("footer", {}, opener()));
const shell = new AppShell();
const server = Server.ofPage();
const workspace = server && new Workspace(shell, server);

/** Shows a model in place of the present one. If it cannot be read, a message says so and the present one stays. */
async function open(source: () => Promise<Source | null>, file?: File): Promise<void> {
  try {
    if (source === ownModel && workspace && ((await workspace.begun)?.kind ?? "model") !== "model") return;
    const given = await source();
    if (!given) {
      if (!workspace) shell.showMessage("Drop a .snapspace file here, or open one.", false, opener());
      return;
    }
    const arrived = performance.now();
    const model = readModel(given.bytes, given.name);
    const module = await shell.module;
    const { stage } = shell;
    shell.clear();
    // the server knows its own model, as number 0, and no file that was dropped here
    const polish = server && source === ownModel ? polishAt(server, () => 0) : undefined;
    const choose = workspace && (() => (file ? void workspace.upload(file) : workspace.edit()));
    // the address is of the page's own model
    const hash = source === ownModel ? location.hash : "";
    const options = { ...shell.options(model.up), polish, motions: motionsOf(hash), blend: blendOf(hash) };
    if (choose) Object.assign(options, { choose });
    if (server && source === ownModel) Object.assign(options, { page: server.address("page", {}) });
    const view =
      model.kind === "posing"
        ? await posingView(stage, module, model, options)
        : await blendingView(stage, module, model, options);
    const now = performance.now();
    shell.show(view, model.name, { openedIn: now - arrived, startedIn: now - started });
  } catch (error) {
    shell.showMessage(readable(error), true, opener());
  }
}

/** Opens a model in the page, or sends a mesh to the server. */
function take(file: File): void {
  if (workspace && !file.name.endsWith(".snapspace")) void workspace.upload(file);
  else void open(() => fromFile(file), file);
}

/** A button that asks for a file. */
function opener(): HTMLElement {
  return document.querySelector('meta[name="snapspace-server"]')
    ? filePicker("Open a mesh or model…", "", take)
    : filePicker("Open a model…", ".snapspace", take);
}

document.addEventListener("dragover", (event) => {
  event.preventDefault();
  document.body.classList.add("dragged-over");
});
document.addEventListener("dragleave", () => document.body.classList.remove("dragged-over"));
document.addEventListener("drop", (event) => {
  event.preventDefault();
  document.body.classList.remove("dragged-over");
  const file = event.dataTransfer?.files[0];
  if (file) take(file);
});
document.getElementById("fold")!.addEventListener("click", (event) => {
  const folded = document.body.classList.toggle("folded");
  (event.currentTarget as HTMLElement).setAttribute("aria-expanded", String(!folded));
});
void open(ownModel);
server?.connect();
