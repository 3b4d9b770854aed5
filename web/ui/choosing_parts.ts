import {
  changedPart,
  FACTORS,
  partNameFault,
  withNewPart,
  withoutPart,
  type ChosenPart,
} from "../engine/parts.ts";
import { union } from "../engine/selecting.ts";
import type { Choosing } from "./choosing.ts";
import { partColorOf } from "./choosing_colors.ts";
import { h, hasMouse, vertexCount } from "./dom.ts";

const [STIFF, SOFT] = [10, 0.1];

/** The list of parts, and the buttons that make one of the selection; `update` shows the present state. */
export class PartList {
  readonly element: HTMLElement;
  readonly #choosing: Choosing;
  readonly #list = h("ul", { className: "handles parts" });
  readonly #hint = h("p", { className: "hint", role: "status" });
  readonly #buttons: readonly HTMLButtonElement[];
  #shown: readonly ChosenPart[] = [];

  constructor(choosing: Choosing) {
    this.#choosing = choosing;
    const button = (label: string, title: string, factor: number) =>
      h("button", { type: "button", title, onclick: () => this.#make(factor) }, label);
    this.#buttons = [
      button("Stiff part", `The selection becomes ${STIFF} times as stiff`, STIFF),
      button("Soft part", `The selection becomes ${1 / SOFT} times as soft`, SOFT),
    ];
    this.element = h("div", {}, h("div", { className: "row" }, ...this.#buttons), this.#hint, this.#list);
  }

  update(): void {
    const { selected, choice } = this.#choosing;
    for (const button of this.#buttons) button.disabled = selected.length === 0;
    if (this.#shown === choice.parts) return;
    this.#shown = choice.parts;
    this.#hint.textContent = "";
    // restores the focus, which a new list would lose
    const focused = document.activeElement?.getAttribute("data-focus");
    this.#list.replaceChildren(...choice.parts.map((part) => this.#item(part)));
    if (focused) this.#list.querySelector<HTMLElement>(`[data-focus="${focused}"]`)?.focus();
  }

  #make(factor: number): void {
    this.#choosing.go(withNewPart(this.#choosing.choice, factor));
    if (hasMouse()) this.#list.querySelector<HTMLInputElement>("li:last-child .name")?.select();
  }

  #item(part: ChosenPart): HTMLElement {
    const { key, name, vertices } = part;
    const swatch = h("button", {
      type: "button",
      className: "swatch",
      title: "Select its vertices",
      "aria-label": `Select the vertices of ${name}`,
      "data-focus": `part-swatch-${key}`,
      onclick: () => {
        const { choice } = this.#choosing;
        this.#choosing.go({ ...choice, selected: union(choice.selected, vertices) });
      },
    });
    swatch.style.background = partColorOf(this.#choosing.choice.parts, key);
    const remove = h(
      "button",
      {
        type: "button",
        className: "small bare",
        "aria-label": `Delete ${name}`,
        title: "Delete",
        onclick: () => this.#choosing.go(withoutPart(this.#choosing.choice, key)),
      },
      "✕",
    );
    return h(
      "li",
      {},
      h("div", { className: "top" }, swatch, this.#name(part), this.#factor(part), remove),
      h("div", { className: "below" }, h("span", {}, vertexCount(vertices.length))),
    );
  }

  #name({ key, name }: ChosenPart): HTMLInputElement {
    const input = h("input", { className: "name", value: name, "data-focus": `part-name-${key}` });
    input.setAttribute("aria-label", "Name of the part");
    input.spellcheck = false;
    input.addEventListener("change", () => {
      const fault = partNameFault(this.#choosing.choice, key, input.value);
      if (fault) {
        this.#hint.textContent = fault;
        input.value = name;
      } else if (input.value.trim() !== name) {
        this.#choosing.go(changedPart(this.#choosing.choice, key, { name: input.value.trim() }));
      }
    });
    this.#leaves(input, name);
    return input;
  }

  #factor({ key, name, factor }: ChosenPart): HTMLElement {
    const input = h("input", { type: "number", required: true, step: "any", ...FACTORS });
    input.value = String(factor);
    input.setAttribute("data-focus", `part-factor-${key}`);
    input.setAttribute("aria-label", `Stiffness of ${name}`);
    input.addEventListener("change", () => {
      if (!input.reportValidity() || input.valueAsNumber === factor) return;
      this.#choosing.go(changedPart(this.#choosing.choice, key, { factor: input.valueAsNumber }));
    });
    this.#leaves(input, String(factor));
    return h("label", { className: "factor", title: "Times as stiff as the rest" }, "×", input);
  }

  /** Enter and Escape end typing; Escape restores the value before. */
  #leaves(input: HTMLInputElement, before: string): void {
    input.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== "Escape") return;
      if (event.key === "Escape") input.value = before;
      event.stopPropagation(); // Enter would make a handle, Escape clear the selection
      this.#choosing.stage.renderer.canvas.focus();
    });
  }
}
