import { h } from "./dom.ts";
import type { Stage } from "./stage.ts";
import { FARTHEST, type Colors, type Surface } from "./surface.ts";

const PAUSE = 250; // milliseconds between two looks at the scale

/** What the colours mean: a ramp with numbers below. The scale of strains follows the shapes, in steps. */
export class Legend {
  readonly element: HTMLElement;
  readonly #stage: Stage;
  readonly #surfaces: readonly Surface[];
  readonly #title = h("span", {});
  readonly #ticks = [h("span", {}), h("span", {}), h("span", {})];
  #colors: Colors = "own";
  #looked = 0;
  #timer = 0;

  constructor(stage: Stage, surfaces: readonly Surface[]) {
    this.#stage = stage;
    this.#surfaces = surfaces;
    const ramp = h("div", { className: "ramp", "aria-hidden": true });
    this.element = h(
      "div",
      { className: "legend", hidden: true },
      this.#title,
      ramp,
      h("div", {}, ...this.#ticks),
    );
  }

  set colors(colors: Colors) {
    this.#colors = colors;
    this.element.hidden = colors === "own" || colors === "material";
    if (colors === "displacement")
      this.#show("Displacement, of the diagonal", [0, FARTHEST / 2, FARTHEST].map(percent));
    if (colors === "strain") this.#rescale();
  }

  /** Before a frame: follows the shapes, a few times a second. */
  look(): void {
    if (this.#colors !== "strain") return;
    const wait = this.#looked + PAUSE - performance.now();
    clearTimeout(this.#timer);
    if (wait <= 0) this.#rescale();
    else this.#timer = window.setTimeout(() => this.#stage.draw(), wait);
  }

  dispose(): void {
    clearTimeout(this.#timer);
  }

  /** One scale for all surfaces: side by side they can be compared. */
  #rescale(): void {
    this.#looked = performance.now();
    const shown = this.#surfaces.filter(({ object }) => object.visible);
    const end = Math.max(...shown.map((surface) => surface.strainScale()));
    for (const surface of this.#surfaces) surface.strainEnd = end;
    this.#show("Strain of the surface", [0, end / 2, end].map(percent));
  }

  #show(title: string, ticks: string[]): void {
    if (this.#title.textContent !== title) this.#title.textContent = title;
    ticks.forEach((text, i) => {
      if (this.#ticks[i].textContent !== text) this.#ticks[i].textContent = text;
    });
  }
}

const percent = (share: number) => `${Number((100 * share).toPrecision(3))} %`;
