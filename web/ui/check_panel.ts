import { Color } from "three";

import type { Checked, SurfaceFinding } from "../engine/messages.ts";
import { flat, Geometry, Mesh } from "../render/index.ts";
import { h, section } from "./dom.ts";
import type { Server } from "./server.ts";
import type { Stage } from "./stage.ts";

const INVENTED = new Color("#e2593f");
const INVENTED_OPACITY = 0.75;

/** What is wrong with the surface that was opened, at the press of a button: a list, and on the stage the faces that
 * close its holes. */
export class CheckPanel {
  readonly elements: readonly HTMLElement[];
  /** Whether the surface is filled, so that it has been mended. */
  isFilled = true;
  readonly #stage: Stage;
  readonly #server: Server;
  readonly #button: HTMLButtonElement;
  readonly #result = h("div", { className: "findings", role: "status" });
  #invented: Mesh | null = null;

  constructor(stage: Stage, server: Server) {
    [this.#stage, this.#server] = [stage, server];
    this.#button = h(
      "button",
      { type: "button", className: "wide", onclick: () => void this.#run() },
      "Check surface",
    );
    this.#button.title = "Holes, flipped and crossing faces, thin parts, and what to do about them";
    this.elements = [section("Surface", this.#button, this.#result)];
  }

  /** Shows the invented faces on the stage, if there are any. */
  show(): void {
    if (this.#invented) this.#stage.root.add(this.#invented);
  }

  hide(): void {
    this.#invented?.removeFromParent();
  }

  dispose(): void {
    this.hide();
    this.#invented?.geometry.dispose();
    this.#invented = null;
  }

  async #run(): Promise<void> {
    this.#button.disabled = true;
    this.#result.replaceChildren(h("p", {}, "Checking…"));
    try {
      const { message: found } = await this.#server.ask({ type: "check" }, "checked");
      this.#result.replaceChildren(...lines(found, this.isFilled));
      this.dispose();
      if (found.invented.length > 0) this.#invented = invented(found.invented);
      if (this.#result.isConnected) this.show();
      this.#stage.draw();
    } catch (error) {
      this.#result.replaceChildren(h("p", { className: "fault" }, (error as Error).message));
    } finally {
      this.#button.disabled = false;
    }
  }
}

function lines(checked: Checked, isFilled: boolean): HTMLElement[] {
  const { fine, findings, mended, invented: positions } = checked;
  const verdict = fine ? "Ready: nothing needs mending." : mendedText(mended, isFilled);
  const first = h("p", { className: fine ? "ready" : "mended" }, verdict);
  const list = h("ul", {}, ...findings.map(item));
  const legend =
    positions.length > 0
      ? [
          h(
            "p",
            { className: "invented" },
            isFilled
              ? "Red on the shape: faces that close holes."
              : "Red on the shape: faces that would close holes.",
          ),
        ]
      : [];
  return [first, ...legend, ...(findings.length > 0 ? [list] : [])];
}

function mendedText(mended: readonly string[], isFilled: boolean): string {
  if (mended.length === 0) return "It has faults, which are left to the filling.";
  const changes = mended.join("; ");
  if (!isFilled) return `A shell stays as it is. A solid would be mended first: ${changes}.`;
  return `Mended before it was filled: ${changes}. Your file is as it was.`;
}

function item({ name, fault, text, meaning, cure }: SurfaceFinding): HTMLElement {
  return h(
    "li",
    { className: fault ? "faulty" : "" },
    h("strong", {}, name),
    ` ${text}`,
    h("span", {}, `It means: ${meaning}.`),
    h("span", {}, `What to do: ${cure}.`),
  );
}

function invented(positions: readonly number[]): Mesh {
  const corners = Float32Array.from(positions);
  const geometry = new Geometry(
    { position: { data: corners, size: 3 } },
    Uint32Array.from({ length: corners.length / 3 }, (_, corner) => corner),
  );
  const mesh = new Mesh(geometry, flat(INVENTED, INVENTED_OPACITY, { isNearer: true }));
  mesh.name = "invented";
  return mesh;
}
