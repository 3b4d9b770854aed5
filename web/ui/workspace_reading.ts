import type { Progress, Workspace as Given } from "../engine/messages.ts";
import { ProgressBar } from "./compute_panel.ts";
import { filePicker, h } from "./dom.ts";
import type { AppShell } from "./app_shell.ts";
import type { Server } from "./server.ts";
import { sendFile } from "./upload.ts";

const MEGABYTE = 2 ** 20;
const SURFACES = [".obj", ".off", ".ply", ".stl", ".glb", ".gltf"];
const TETS = [".mesh", ".msh", ".vtk", ".vtu", ".veg"];

/** The box above everything: asks for a mesh, sends it, and waits until the server has read and filled it. */
export class ReadingBox {
  readonly #shell: AppShell;
  readonly #server: Server;
  readonly #bar = new ProgressBar();
  readonly #elapsed = h("span", { className: "detail" });
  readonly #reopen: (thickness: number | null) => void;
  #clock = 0;
  #given: Given | null = null;
  /** While a file is sent and read, which replaces nothing before it has been read. */
  #sending: AbortController | null = null;
  /** Shows again what was there before a file was sent. */
  #back: () => void;
  #isShown = false;
  /** Whether the surface that is filled stays visible. */
  #isBelow = false;

  constructor(shell: AppShell, server: Server, reopen: (thickness: number | null) => void) {
    this.#shell = shell;
    this.#server = server;
    this.#reopen = reopen;
    this.#back = () => shell.quiet();
  }

  /** Asks for a mesh. */
  ask(given: Given): void {
    this.#now(given, () => this.ask(given));
    this.#isShown = false;
    clearInterval(this.#clock);
    const formats = h(
      "p",
      { className: "formats" },
      `A surface (${SURFACES.join(" ")}), or tets (${TETS.join(" ")}). A closed surface is filled with tets, an open one is a shell.`,
    );
    this.#shell.showMessage("Drop a mesh here", false, formats, this.#picker());
  }

  async upload(file: File, given: Given): Promise<void> {
    this.#sending?.abort();
    const sending = (this.#sending = new AbortController());
    this.#given = given;
    const known = [...SURFACES, ...TETS, ".snapspace"];
    if (!known.some((suffix) => file.name.toLowerCase().endsWith(suffix))) {
      this.failed(`${file.name} cannot be read here. Open a file of these types: ${known.join(" ")}.`);
      return;
    }
    if (!this.#server.isOpen) {
      this.failed(`${file.name} was not sent: there is no connection to the server.`);
      return;
    }
    if (file.size > given.upload_limit) {
      const [size, most] = [file.size, given.upload_limit].map((bytes) => (bytes / MEGABYTE).toFixed(0));
      this.failed(
        `${file.name} has ${size} MB, but the server takes at most ${most} MB. ` +
          "Start it with a larger --upload-limit, or with the mesh: `snapspace view MESH`.",
      );
      return;
    }
    const request = String(this.#server.number()); // before that of a cancel
    const address = this.#server.address("mesh", { workspace: given.id, name: file.name, request });
    this.#show(`Sending ${file.name}`);
    const onProgress = (done: number, total: number) =>
      this.#bar.show({
        stage: "Sent",
        done: tenths(done),
        total: tenths(total),
        eta: null,
        error: null,
      });
    try {
      await sendFile(address, file, onProgress, sending.signal);
    } catch (error) {
      this.failed((error as Error).message);
    }
  }

  /** Shows that the server reads a mesh. */
  wait(given: Given): void {
    this.#now(given, () => this.wait(given));
    this.#show(`Opening ${given.name}`);
  }

  /** Shows, below its surface, that the server fills it. */
  fill(given: Given): void {
    this.#now(given, () => this.fill(given));
    if (!this.#isShown) this.#begin();
    this.#isBelow = true;
    this.#tell(`Making a solid of ${given.name}`); // the stages say how
    this.#shell.messageBelow = true;
  }

  /** There is a mesh, and the box is not needed. */
  done(): void {
    this.#now(this.#given, () => this.#shell.quiet());
    this.#isShown = false;
    clearInterval(this.#clock);
  }

  /** The state of the workspace, and what shows it. */
  #now(given: Given | null, show: () => void): void {
    [this.#given, this.#back, this.#sending] = [given, show, null];
    this.#isBelow = false;
  }

  progress(progress: Progress): void {
    if (this.#isShown) this.#bar.show(progress);
  }

  /** After the connection was lost: nothing is known of what the server opens, and nothing can stop it. */
  lose(): void {
    clearInterval(this.#clock);
    if (!this.#isShown || this.#sending) return;
    this.#isShown = false;
    this.#shell.quiet();
  }

  failed(message: string): void {
    if (this.#isBelow && !this.#sending) this.#back = () => this.failed(message); // to fill the surface
    this.#sending = null;
    this.#isShown = false;
    clearInterval(this.#clock);
    this.#shell.showMessage(message.replace(/^snapspace: /, ""), true, ...this.#asShell(), this.#picker());
    this.#shell.messageBelow = this.#isBelow;
  }

  #show(text: string): void {
    this.#begin();
    this.#tell(text);
  }

  #begin(): void {
    this.#isShown = true;
    this.#bar.element.hidden = true;
    this.#countFrom(performance.now());
  }

  #tell(text: string): void {
    const cancel = h("button", { type: "button", onclick: () => this.#cancel() }, "Cancel");
    this.#shell.showMessage(text, false, this.#bar.element, this.#elapsed, ...this.#asShell(), cancel);
  }

  /** A button that takes the surface as it is, while it is filled and after that has failed. */
  #asShell(): HTMLElement[] {
    const thickness = this.#isBelow ? this.#given?.usual_thickness : null;
    if (typeof thickness !== "number") return [];
    const title = "A thin body: the surface stays as it is";
    const onclick = () => this.#reopen(thickness);
    return [h("button", { type: "button", title, onclick }, "Use as a shell")];
  }

  /** Shows how long it has taken, after the first second. */
  #countFrom(begin: number): void {
    clearInterval(this.#clock);
    this.#elapsed.textContent = "";
    this.#clock = window.setInterval(() => {
      if (!this.#elapsed.isConnected) return;
      this.#elapsed.textContent = `${Math.round((performance.now() - begin) / 1000)} s so far`;
    }, 1000);
  }

  #cancel(): void {
    this.#isShown = false;
    clearInterval(this.#clock);
    const upload = this.#sending !== null;
    this.#sending?.abort();
    if (this.#server.isOpen) this.#server.send({ type: "cancel", upload });
    if (upload) this.#back();
    else if (this.#given) this.ask(this.#given);
  }

  #picker(): HTMLElement {
    return filePicker("Open a mesh…", "", (file) => void this.upload(file, this.#given!));
  }
}

/** Megabytes, to a tenth. */
function tenths(bytes: number): number {
  return Math.round((10 * bytes) / MEGABYTE) / 10;
}
