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
  #sending: AbortController | null = null;
  #isShown = false;
  /** Whether the surface that is filled stays visible. */
  #isBelow = false;

  constructor(shell: AppShell, server: Server, reopen: (thickness: number | null) => void) {
    this.#shell = shell;
    this.#server = server;
    this.#reopen = reopen;
  }

  /** Asks for a mesh. */
  ask(given: Given): void {
    this.#given = given;
    this.#isShown = this.#isBelow = false;
    clearInterval(this.#clock);
    const formats = h(
      "p",
      { className: "formats" },
      `A surface (${SURFACES.join(" ")}), or tets (${TETS.join(" ")}). A closed surface is filled with tets, an open one is a shell.`,
    );
    this.#shell.showMessage("Drop a mesh here", false, formats, this.#picker());
  }

  async upload(file: File, given: Given): Promise<void> {
    this.#given = given;
    const known = [...SURFACES, ...TETS, ".snapspace"];
    if (!known.some((suffix) => file.name.toLowerCase().endsWith(suffix))) {
      this.failed(`${file.name} cannot be read here. Open a file of these types: ${known.join(" ")}.`);
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
    this.#sending = new AbortController();
    const address = this.#server.address("mesh", { workspace: given.id, name: file.name });
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
      await sendFile(address, file, onProgress, this.#sending.signal);
    } catch (error) {
      this.failed((error as Error).message);
    }
  }

  /** Shows that the server reads a mesh. */
  wait(given: Given): void {
    this.#given = given;
    this.#isBelow = false;
    this.#show(`Opening ${given.name}`);
  }

  /** Shows, below its surface, that the server fills it. */
  fill(given: Given): void {
    this.#given = given;
    if (!this.#isShown) this.#begin();
    this.#isBelow = true;
    this.#tell(`Filling ${given.name} with tets`);
    this.#shell.messageBelow = true;
  }

  /** There is a mesh, and the box is not needed. */
  done(): void {
    this.#isShown = this.#isBelow = false;
    clearInterval(this.#clock);
  }

  progress(progress: Progress): void {
    if (this.#isShown) this.#bar.show(progress);
  }

  /** Stops the clock after the connection was lost. */
  lose(): void {
    clearInterval(this.#clock);
  }

  failed(message: string): void {
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
    this.#sending?.abort();
    if (this.#server.isOpen) this.#server.send({ type: "cancel" });
    if (this.#given) this.ask(this.#given);
  }

  #picker(): HTMLElement {
    return filePicker("Open a mesh…", "", (file) => void this.upload(file, this.#given!));
  }
}

/** Megabytes, to a tenth. */
function tenths(bytes: number): number {
  return Math.round((10 * bytes) / MEGABYTE) / 10;
}
