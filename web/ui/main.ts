import { readModel } from "../engine/index.ts";
import { stateOf } from "./address.ts";
import { blendingView } from "./blending_view.ts";
import { filePicker, h } from "./dom.ts";
import { exportPage } from "./export_page.ts";
import { polishAt } from "./polishing.ts";
import { posingView } from "./posing_view.ts";
import { readable, AppShell } from "./app_shell.ts";
import { Server } from "./server.ts";
import { fromFile, ownModel, type Source } from "./source.ts";
import type { View } from "./view.ts";
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

/** Why kept points stay soft in a model that was opened in the page of a server. */
const NOT_SERVED =
  "Kept points stay soft: the server does not have this model. Start `snapspace view` with its file, and it can improve it.";
const started = performance.now();
window.snapspace = {};
document.getElementById("panel")!.append(h("footer", {}, opener()));
const shell = new AppShell();
const server = Server.ofPage();
const workspace = server && new Workspace(shell, server);

/** Shows a model in place of the present one. If it cannot be read, a message says so and the present one stays. */
async function open(source: () => Promise<Source | null>, file?: File): Promise<void> {
  try {
    const begun = source === ownModel && workspace ? await workspace.begun : null;
    if (begun && (begun.kind !== "model" || begun.has_model)) return; // the workspace shows something else
    const given = await source();
    if (!given) {
      if (!workspace) shell.showMessage("Drop a .snapspace file here, or open one.", false, opener());
      return;
    }
    const arrived = performance.now();
    const model = readModel(given.bytes, given.name);
    const module = await shell.module;
    const { stage } = shell;
    if (workspace) workspace.leave();
    else shell.clear();
    // the server knows its own model, as number 0, and no file that was dropped here
    const isOwn = source === ownModel;
    const polish = server && isOwn ? polishAt(server, () => workspace!.shownModel) : undefined;
    let view: View | null = null;
    const choose = workspace && (() => workspace.edit(view?.state, file));
    // the address is of the page's own model
    const hash = isOwn ? location.hash : "";
    const options = { ...shell.options(model.up), ...stateOf(hash), isFromFile: !isOwn, polish };
    if (choose) Object.assign(options, { choose });
    if (workspace) Object.assign(options, { improving: isOwn ? workspace.improving : NOT_SERVED });
    if (server && isOwn) {
      const page = (timeline: string | null) =>
        exportPage(server, { model: workspace!.shownModel, name: model.name, up: stage.up, timeline });
      Object.assign(options, { page });
    }
    const show = (view: View) => {
      const now = performance.now();
      shell.show(view, model.name, { openedIn: now - arrived, startedIn: now - started });
    };
    if (model.kind === "interpolation")
      return show((view = await blendingView(stage, module, model, options)));
    const posing = (view = await posingView(stage, module, model, options));
    show(workspace && isOwn ? workspace.adopt(model, posing) : view);
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
