import type { ScreenPoint } from "../engine/selecting.ts";

const SVG = "http://www.w3.org/2000/svg";

/** What a tool draws over the stage: the brush's ring, a rubber band. */
export class ToolOverlay {
  readonly element = document.createElementNS(SVG, "svg");
  readonly #ring = this.#part("circle", "ring");
  readonly #band = this.#part("path", "band");

  constructor() {
    this.element.classList.add("tool-overlay");
    this.element.setAttribute("aria-hidden", "true");
    this.clear();
  }

  ring([x, y]: ScreenPoint, radius: number, remove: boolean): void {
    this.#ring.setAttribute("cx", String(x));
    this.#ring.setAttribute("cy", String(y));
    this.#ring.setAttribute("r", String(Math.max(radius, 2)));
    this.#show(this.#ring, remove);
  }

  box([ax, ay]: ScreenPoint, [bx, by]: ScreenPoint, remove: boolean): void {
    this.#band.setAttribute("d", `M${ax} ${ay}H${bx}V${by}H${ax}Z`);
    this.#show(this.#band, remove);
  }

  line(line: readonly ScreenPoint[], remove: boolean): void {
    this.#band.setAttribute("d", `M${line.map(([x, y]) => `${x} ${y}`).join("L")}Z`);
    this.#show(this.#band, remove);
  }

  clear(): void {
    for (const part of [this.#ring, this.#band]) part.style.display = "none";
  }

  #show(part: SVGElement, remove: boolean): void {
    part.style.display = "";
    part.classList.toggle("removes", remove);
  }

  #part(tag: "circle" | "path", name: string): SVGElement {
    const part = document.createElementNS(SVG, tag);
    part.classList.add(name);
    this.element.append(part);
    return part;
  }
}
