import {
  changed,
  lacking,
  losses,
  nameFault,
  withMore,
  withNewHandle,
  withoutHandle,
  type Choice,
  type ChosenHandle,
} from "../engine/choice.ts";
import { union } from "../engine/selecting.ts";
import type { Choosing } from "./choosing.ts";
import { colorOf } from "./choosing_colors.ts";
import type { HandleMirror } from "./choosing_mirror.ts";
import type { CommonRanges } from "./choosing_sampling.ts";
import { h, hasMouse, section, vertexCount } from "./dom.ts";
import { DEGREES, rangeFields, shareOf } from "./range_fields.ts";

/** The list of handles, and the button that makes one of the selection; `update` shows the present state. */
export class HandleList {
  readonly element: HTMLElement;
  readonly #choosing: Choosing;
  readonly #common: CommonRanges;
  readonly #mirror: HandleMirror;
  readonly #list = h("ul", { className: "handles" });
  readonly #make = h("button", { type: "button", className: "primary wide", title: "Enter" });
  /** The same button on the stage, for narrow windows. */
  readonly floating = h("button", { type: "button", className: "primary floating" });
  readonly #hint = h("p", { className: "hint", role: "status" });
  readonly #lacking = h("p", { className: "hint", id: "lacking" });
  /** Keys of the handles whose ranges are shown. */
  readonly #unfolded = new Set<number>();
  #shown: readonly ChosenHandle[] | null = null;
  #hadSelection = false;

  constructor(choosing: Choosing, common: CommonRanges, mirror: HandleMirror) {
    this.#choosing = choosing;
    this.#common = common;
    this.#mirror = mirror;
    for (const button of [this.#make, this.floating]) button.addEventListener("click", () => this.make());
    this.element = section("Handles", this.#lacking, this.#make, this.#hint, this.#list, mirror.element);
  }

  /** Makes a handle of the selected vertices; its name can be typed at once. */
  make(): void {
    if (this.#choosing.choice.selected.length === 0) return;
    this.#go(withNewHandle(this.#choosing.choice));
    // where there is a keyboard: on a phone it would cover the stage
    if (hasMouse()) this.#list.querySelector<HTMLInputElement>("li:last-child .name")?.select();
  }

  /** Makes the mirror image of the handle that has the focus, or of the last one. */
  mirror(): void {
    const key = document.activeElement?.closest<HTMLElement>("li[data-handle]")?.dataset["handle"];
    const { handles } = this.#choosing.choice;
    const handle = handles.find((handle) => String(handle.key) === key) ?? handles.at(-1);
    if (handle) void this.#mirror.mirror(handle);
  }

  update(): void {
    const { selected, choice } = this.#choosing;
    const count = selected.length;
    this.#lacking.textContent = lacking(choice);
    this.#make.disabled = count === 0;
    const text = count === 0 ? "New handle" : `New handle · ${vertexCount(count)}`;
    for (const button of [this.#make, this.floating])
      if (button.textContent !== text) button.textContent = text;
    this.floating.hidden = count === 0;
    if (this.#shown === choice.handles && this.#hadSelection === count > 0) return;
    if (this.#shown !== choice.handles && !this.#hint.dataset["kept"]) this.#hint.textContent = "";
    delete this.#hint.dataset["kept"];
    this.#shown = choice.handles;
    this.#hadSelection = count > 0;
    // restores the focus, which a new list would lose
    const focused = document.activeElement?.getAttribute("data-focus");
    this.#list.replaceChildren(...choice.handles.map((handle) => this.#item(handle, count > 0)));
    if (focused) this.#list.querySelector<HTMLElement>(`[data-focus="${focused}"]`)?.focus();
  }

  #go(next: Choice): void {
    this.#showHint(losses(this.#choosing.choice, next));
    this.#choosing.go(next);
  }

  #showHint(text: string): void {
    this.#hint.textContent = text;
    this.#hint.dataset["kept"] = "yes";
  }

  #item(handle: ChosenHandle, hasSelection: boolean): HTMLElement {
    const { key, moving } = handle;
    const { choice } = this.#choosing;
    const own = (name: string) => ({ "data-focus": `${name}-${key}` });
    const swatch = h("button", {
      type: "button",
      className: "swatch",
      title: "Select its vertices",
      "aria-label": `Select the vertices of ${handle.name}`,
      ...own("swatch"),
      onclick: () => this.#choosing.go({ ...choice, selected: union(choice.selected, handle.vertices) }),
    });
    swatch.style.background = colorOf(choice.handles, key);
    const held = h(
      "button",
      {
        type: "button",
        className: "small",
        title: moving ? "It moves. Press to hold it in place." : "It stays in place. Press to let it move.",
        "aria-pressed": !moving,
        ...own("fixed"),
        onclick: () => this.#go(changed(choice, key, { moving: !moving })),
      },
      "Fixed",
    );
    const remove = h(
      "button",
      {
        type: "button",
        className: "small bare",
        "aria-label": `Delete ${handle.name}`,
        title: "Delete",
        onclick: () => this.#choosing.go(withoutHandle(this.#choosing.choice, key)),
      },
      "✕",
    );
    const below = h("div", { className: "below" }, h("span", {}, vertexCount(handle.vertices.length)));
    below.append(
      h(
        "button",
        {
          type: "button",
          className: "link",
          title: "Make its mirror image on the other side; M",
          "aria-label": `Mirror ${handle.name}`,
          ...own("mirror"),
          onclick: () => void this.#mirror.mirror(handle),
        },
        "Mirror",
      ),
    );
    if (hasSelection)
      below.append(
        h(
          "button",
          {
            type: "button",
            className: "link",
            title: "Add the selection to this handle",
            "aria-label": `Add the selection to ${handle.name}`,
            ...own("more"),
            onclick: () => this.#go(withMore(this.#choosing.choice, key)),
          },
          "Extend",
        ),
      );
    const item = h(
      "li",
      { "data-handle": key },
      h("div", { className: "top" }, swatch, this.#name(handle), held, remove),
      below,
    );
    if (moving) this.#ranges(handle, item, below);
    return item;
  }

  #name(handle: ChosenHandle): HTMLInputElement {
    const { key } = handle;
    const input = h("input", { className: "name", value: handle.name, "data-focus": `name-${key}` });
    input.setAttribute("aria-label", "Name of the handle");
    input.spellcheck = false;
    const take = () => {
      const fault = nameFault(this.#choosing.choice, key, input.value);
      if (fault) {
        this.#showHint(fault);
        input.value = handle.name;
      } else if (input.value.trim() !== handle.name) {
        this.#go(changed(this.#choosing.choice, key, { name: input.value.trim() }));
      }
    };
    input.addEventListener("change", take);
    input.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== "Escape") return;
      if (event.key === "Escape") input.value = handle.name;
      event.stopPropagation(); // Enter would make a handle, Escape clear the selection
      this.#choosing.stage.renderer.canvas.focus();
    });
    return input;
  }

  /** Own ranges of a handle, below its line once it is unfolded. */
  #ranges(handle: ChosenHandle, item: HTMLElement, below: HTMLElement): void {
    const { key } = handle;
    const isOwn = handle.translation !== null || handle.angle !== null;
    const set = (fields: Partial<ChosenHandle>) => {
      const next = changed(this.#choosing.choice, key, fields);
      this.#shown = next.handles; // the fields that are typed in stay
      this.#choosing.go(next);
    };
    const common = this.#common();
    const diagonal = this.#choosing.mesh.diagonal;
    const fields = h(
      "div",
      { id: `ranges-${key}`, hidden: !this.#unfolded.has(key) },
      rangeFields(shareOf(diagonal), handle.translation ?? common.translation, (translation) =>
        set({ translation }),
      ),
      rangeFields(DEGREES, handle.angle ?? common.angle, (angle) => set({ angle })),
    );
    const unfold = h(
      "button",
      {
        type: "button",
        className: "link",
        "aria-expanded": !fields.hidden,
        "aria-controls": fields.id,
        "data-focus": `range-${key}`,
        onclick: () => {
          fields.hidden = !fields.hidden;
          unfold.setAttribute("aria-expanded", String(!fields.hidden));
          if (fields.hidden) this.#unfolded.delete(key);
          else this.#unfolded.add(key);
        },
      },
      isOwn ? "Own range" : "Range",
    );
    below.append(unfold);
    item.append(fields);
  }
}
