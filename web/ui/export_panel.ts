import { glbFile, objFile, plyFile } from "../engine/index.ts";
import { currentAddress } from "./address.ts";
import { h, section, toggle } from "./dom.ts";
import { download } from "./download.ts";
import { gifTurntable, Recording, webmTurntable } from "./film.ts";
import { paper, png, type Size } from "./picture.ts";
import { Refused } from "./server.ts";
import type { Stage } from "./stage.ts";

/** What is taken out of the page. */
export interface Exported {
  readonly name: string;
  readonly faces: Uint32Array<ArrayBuffer>;
  /** The shape as it is shown, in the model's coordinates. */
  shape(): Float32Array<ArrayBuffer>;
  /** Gives the user a page in one file with the model, if there is a server. */
  readonly page?: (() => Promise<void>) | undefined;
  /** Whether the page's address does not lead to the shape, as for a file that was opened in the page. */
  readonly isFromFile?: boolean | undefined;
  /** Hides what is no part of the shape, such as a gizmo; the result shows it again. */
  bare(): () => void;
}

const FIRST: Size = { width: 1920, height: 1080 };
const LARGEST = 16_384;
/** Films: seconds of a turn, and the longer side of a GIF in pixels. */
const [SECONDS, LONGEST, GIF_SIDE] = [6, 60, 480];

/** The section with which a user takes away shape, pictures, films and the address. */
export class ExportPanel {
  readonly element: HTMLElement;
  readonly #stage: Stage;
  readonly #exported: Exported;
  readonly #remark = h("p", { className: "hint", role: "status" });
  readonly #transparent = toggle("Transparent", "No background", true, () => {});
  readonly #width = sizeField("Width in pixels", FIRST.width);
  readonly #height = sizeField("Height in pixels", FIRST.height);
  readonly #seconds = h("input", { type: "number", min: 1, max: LONGEST, step: "any", required: true });
  readonly #record: HTMLButtonElement;
  readonly #films: HTMLButtonElement[];
  #recording: Recording | null = null;
  /** Ends the turntable that is being made. */
  #turning: AbortController | null = null;

  constructor(stage: Stage, exported: Exported) {
    [this.#stage, this.#exported] = [stage, exported];
    const button = (label: string, title: string, act: () => void | Promise<void>) =>
      h("button", { type: "button", title, onclick: () => void this.#try(act) }, label);
    const shape = (
      suffix: string,
      what: string,
      type: string,
      make: () => string | Uint8Array<ArrayBuffer>,
    ) => button(suffix.toUpperCase(), `The shape as ${what}`, () => this.#give(make(), suffix, type));
    const { faces } = exported;
    this.#record = toggle(
      "Record",
      "What happens on the stage, as a WebM film",
      false,
      (on) => void this.#try(() => this.#recordOrGive(on)),
    );
    this.#films = [
      button("Turn, WebM", "The shape from all around", () => this.#turn("webm")),
      button("Turn, GIF", `The shape from all around, ${GIF_SIDE} pixels`, () => this.#turn("gif")),
    ];
    this.#seconds.value = String(SECONDS);
    this.#seconds.setAttribute("aria-label", "Seconds of a turn");
    const { page } = exported;
    const whole = page ? [button("HTML", "A page in one file, which needs no server", page)] : [];
    if (!Recording.isPossible) for (const film of [this.#record, this.#films[0]]) film.disabled = true;
    this.element = section(
      "Take away",
      h(
        "div",
        { className: "row" },
        shape("obj", "Wavefront OBJ", "model/obj", () => objFile(exported.shape(), faces)),
        shape("ply", "PLY, binary", "application/octet-stream", () => plyFile(exported.shape(), faces)),
        shape("glb", "binary glTF", "model/gltf-binary", () =>
          glbFile(exported.shape(), faces, stage.up, exported.name),
        ),
        ...whole,
        button("Copy link", "The address of this page with the present pose", () => this.#link()),
      ),
      h(
        "div",
        { className: "row picture-size" },
        this.#width,
        h("span", { "aria-hidden": true }, "×"),
        this.#height,
        this.#transparent,
        button("PNG", "A picture of the stage", () => this.#picture()),
      ),
      h(
        "div",
        { className: "row picture-size" },
        this.#record,
        ...this.#films,
        this.#seconds,
        h("span", {}, "s"),
      ),
      this.#remark,
    );
  }

  /** Ends films that are being made. */
  dispose(): void {
    this.#turning?.abort();
    void this.#recording?.stop();
  }

  #give(content: BlobPart, suffix: string, type: string): void {
    const name = `${this.#exported.name || "snapspace"}.${suffix}`;
    download(content, name, type);
    this.#remark.textContent = `${name} is in your downloads.`;
  }

  async #picture(): Promise<void> {
    const fields = [this.#width, this.#height];
    if (!fields.every((field) => field.reportValidity())) return;
    const [width, height] = fields.map((field) => field.valueAsNumber);
    const isTransparent = this.#transparent.getAttribute("aria-pressed") === "true";
    const show = this.#exported.bare();
    try {
      const picture = png(this.#stage, { width, height }, isTransparent ? null : paper());
      this.#give(await picture, "png", "image/png");
    } finally {
      show();
    }
  }

  async #recordOrGive(on: boolean): Promise<void> {
    if (on) {
      this.#recording = new Recording(this.#stage.renderer.canvas);
      this.#remark.textContent = "Recording; press Record again to end the film.";
      this.#stage.draw(); // the first frame
      return;
    }
    const recording = this.#recording;
    this.#recording = null;
    if (recording) this.#give(await recording.stop(), "webm", "video/webm");
  }

  async #turn(kind: "webm" | "gif"): Promise<void> {
    if (this.#turning) return this.#turning.abort();
    if (!this.#seconds.reportValidity()) return;
    const { signal } = (this.#turning = new AbortController());
    const seconds = this.#seconds.valueAsNumber;
    const show = this.#exported.bare();
    const [button, other] = kind === "webm" ? this.#films : this.#films.toReversed();
    const label = button.textContent;
    button.style.minWidth = `${button.offsetWidth}px`; // the row stays as it is
    button.textContent = "Cancel";
    other.disabled = true;
    this.#remark.textContent = "Turning…";
    try {
      const film =
        kind === "webm"
          ? await webmTurntable(this.#stage, seconds, signal)
          : await this.#gif(seconds, signal);
      if (signal.aborted) this.#remark.textContent = "";
      else this.#give(film, kind, kind === "webm" ? "video/webm" : "image/gif");
    } finally {
      show();
      this.#turning = null;
      button.textContent = label;
      button.style.minWidth = "";
      other.disabled = false;
      this.#films[0].disabled = !Recording.isPossible;
    }
  }

  #gif(seconds: number, signal: AbortSignal): Promise<Uint8Array<ArrayBuffer>> {
    const { aspect } = this.#stage.camera;
    const longer = (share: number) => Math.max(1, Math.round(GIF_SIDE * Math.min(1, share)));
    const size = { width: longer(aspect), height: longer(1 / aspect) };
    return gifTurntable(this.#stage, size, seconds, signal, (share) => {
      this.#remark.textContent = `Turning, ${Math.round(100 * share)} %`;
    });
  }

  async #link(): Promise<void> {
    if (this.#exported.isFromFile) {
      this.#remark.textContent = "This model was opened from a file: no address shows it.";
      return;
    }
    const address = currentAddress();
    try {
      await navigator.clipboard.writeText(address);
      this.#remark.textContent = "The address of this pose is in the clipboard.";
    } catch {
      // not allowed here, as in frames of notebooks: shown to be copied by hand
      const field = h("input", { readOnly: true, value: address });
      field.setAttribute("aria-label", "The address of this pose");
      this.#remark.replaceChildren(field);
      field.select();
    }
  }

  async #try(act: () => void | Promise<void>): Promise<void> {
    try {
      await act();
    } catch (error) {
      const isExpected = error instanceof RangeError || error instanceof Refused;
      if (!isExpected) console.error(error);
      this.#remark.textContent = error instanceof Error ? error.message : String(error);
    }
  }
}

function sizeField(label: string, value: number): HTMLInputElement {
  const input = h("input", { type: "number", min: 1, max: LARGEST, step: 1, required: true });
  input.value = String(value);
  input.setAttribute("aria-label", label);
  return input;
}
