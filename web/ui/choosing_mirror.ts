import { handleMessages, losses, withMirrored, type ChosenHandle } from "../engine/choice.ts";
import type { Mirrored } from "../engine/messages.ts";
import type { Choosing } from "./choosing.ts";
import { choice, h, toggle } from "./dom.ts";
import { MirrorPlane } from "./mirror_plane.ts";
import type { Server } from "./server.ts";
import type { Axis } from "./stage.ts";

const FOUND = "found";
const EXACT = 5e-5; // share of the diagonal
type Across = Axis | typeof FOUND;

/** Makes mirror images of handles, and shows the plane: found by the server, or across an axis that the user chooses. */
export class HandleMirror {
  /** Hidden until the first handle is mirrored. */
  readonly element: HTMLElement;
  readonly #choosing: Choosing;
  readonly #server: Pick<Server, "ask">;
  readonly #plane: MirrorPlane;
  readonly #hint = h("p", { className: "hint", role: "status" });
  #across: Across = FOUND;
  /** Key of the handle that was mirrored last. */
  #last = -1;

  constructor(choosing: Choosing, server: Pick<Server, "ask">) {
    [this.#choosing, this.#server] = [choosing, server];
    this.#plane = new MirrorPlane(choosing.stage, choosing.mesh);
    const options = [
      [FOUND, "Plane found"],
      ["x", "Across x"],
      ["y", "Across y"],
      ["z", "Across z"],
    ] as const;
    const axes = choice<Across>("Mirror plane", options, FOUND, (across) => {
      this.#across = across;
      void this.#again();
    });
    const show = toggle("Show plane", "The mirror plane on the shape", true, (on) => this.#plane.show(on));
    this.element = h(
      "div",
      { className: "mirror", hidden: true },
      this.#hint,
      axes.element,
      h("div", { className: "row" }, show),
    );
  }

  /** Makes the mirror image of a handle, in place of the handle that has its name. */
  async mirror(handle: ChosenHandle): Promise<void> {
    this.#last = handle.key;
    this.element.hidden = false;
    const [message] = handleMessages([handle]);
    const axis = this.#across === FOUND ? null : this.#across;
    try {
      const answer = await this.#server.ask({ type: "mirror", handle: message, axis }, "mirrored");
      this.#take(handle, answer.message);
    } catch (error) {
      this.#say((error as Error).message, true);
    }
  }

  dispose(): void {
    this.#plane.dispose();
  }

  /** Mirrors the last handle again, across another plane. */
  async #again(): Promise<void> {
    const handle = this.#choosing.choice.handles.find(({ key }) => key === this.#last);
    if (handle) await this.mirror(handle);
  }

  #take(handle: ChosenHandle, { handle: image, normal, point, deviation }: Mirrored): void {
    this.#plane.put(normal, point);
    const before = this.#choosing.choice;
    const next = withMirrored(before, handle.key, image);
    if (!next) return this.#say(`There is nothing left at the mirror image of ${handle.name}.`, true);
    const others = { ...before, handles: before.handles.filter(({ name }) => name !== image.name) };
    const made = `${image.name} is the mirror image of ${handle.name}.`;
    this.#say([made, symmetry(deviation), losses(others, next)].join(" "), false);
    if (!this.#choosing.isBusy) this.#choosing.go(next);
  }

  #say(text: string, isFault: boolean): void {
    this.#hint.textContent = `${text.charAt(0).toUpperCase()}${text.slice(1)}`.trim();
    this.#hint.classList.toggle("fault", isFault);
    this.element.scrollIntoView({ block: "center" });
  }
}

/** How symmetric the shape is; empty if that is not known. */
function symmetry(deviation: number | null): string {
  if (deviation === null) return "";
  if (deviation < EXACT) return "The shape is symmetric.";
  return `The shape and its mirror image differ by ${Number((100 * deviation).toPrecision(2))} % of its size.`;
}
