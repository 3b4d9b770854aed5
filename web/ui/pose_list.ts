import { h, mark, setText } from "./dom.ts";
import { MOST_CHOSEN } from "./pose_choice.ts";
import { isFound, nameInGroup, poseGroups } from "./pose_groups.ts";

/** Many poses as small pictures in groups, with a search: a click, Space or Enter adds a pose to the blend or takes it away.
 *
 * Tab reaches one picture, and arrows lead to the others, so that Tab needs one step for the whole list. */
export class PoseList {
  readonly element: HTMLElement;
  readonly search: HTMLInputElement;
  readonly #names: readonly string[];
  readonly #buttons: readonly HTMLButtonElement[];
  readonly #pictures: readonly HTMLImageElement[];
  readonly #groups: { element: HTMLDetailsElement; count: HTMLElement; poses: readonly number[] }[];
  readonly #hint = h("p", { className: "hint", role: "status" });
  readonly #act: (pose: number) => void;
  #chosen: readonly number[] = [];

  /** `act` gets a pose to add or to take away. */
  constructor(names: readonly string[], act: (pose: number) => void) {
    this.#names = names;
    this.#act = act;
    this.#pictures = names.map(() => h("img", { alt: "", width: 52, height: 52, draggable: false }));
    this.#buttons = names.map((name, pose) =>
      h("button", {
        type: "button",
        className: "pose",
        title: name,
        "aria-label": name,
        "aria-pressed": false,
        tabIndex: -1,
        onclick: () => this.#toggle(pose),
      }),
    );
    this.#groups = poseGroups(names).map((group, _, { length }) => {
      const count = h("span", { className: "detail" });
      for (const pose of group.poses)
        this.#buttons[pose].append(this.#pictures[pose], h("span", {}, nameInGroup(names[pose], group)));
      const title = group.name || (length > 1 ? "Others" : "All");
      const element = h(
        "details",
        { open: true, className: "group" },
        h("summary", {}, h("span", {}, title), count),
        h("div", { className: "pictures" }, ...group.poses.map((pose) => this.#buttons[pose])),
      );
      return { element, count, poses: group.poses };
    });
    this.search = this.#field();
    const groups = h("div", { className: "poses", role: "group", "aria-label": "Poses" });
    groups.append(...this.#groups.map(({ element }) => element), this.#hint);
    groups.addEventListener("keydown", (event) => this.#go(event));
    groups.addEventListener("focusin", ({ target }) => this.#stop(target as HTMLElement));
    this.element = h("div", {}, this.search, groups);
    this.#stop(this.#buttons[this.#groups[0].poses[0]]);
  }

  /** Shows a picture of a pose. */
  illustrate(pose: number, address: string): void {
    this.#pictures[pose].src = address;
  }

  /** Shows which poses take part. */
  show(chosen: readonly number[]): void {
    this.#chosen = chosen;
    this.#buttons.forEach((button, pose) => mark(button, "aria-pressed", chosen.includes(pose)));
    for (const { count, poses } of this.#groups) {
      const taking = poses.filter((pose) => chosen.includes(pose)).length;
      setText(count, taking > 0 ? `${taking} of ${poses.length}` : String(poses.length));
    }
    setText(this.#hint, "");
  }

  #toggle(pose: number): void {
    const takesPart = this.#chosen.includes(pose);
    if (takesPart && this.#chosen.length === 1) {
      setText(this.#hint, "One pose must stay. Choose another one first.");
    } else if (!takesPart && this.#chosen.length >= MOST_CHOSEN) {
      setText(this.#hint, `A blend takes ${MOST_CHOSEN} poses at most. Remove one first.`);
    } else {
      this.#act(pose);
    }
  }

  #field(): HTMLInputElement {
    const field = h("input", {
      type: "search",
      placeholder: `Search ${this.#names.length} poses`,
      "aria-label": "Search the poses. Enter adds or removes the first one found.",
      title: "/",
      spellcheck: false,
      autocomplete: "off",
    });
    field.addEventListener("input", () => this.#find(field.value));
    field.addEventListener("keydown", (event) => {
      const first = this.#shown()[0];
      if (event.key === "Escape" && field.value !== "") {
        field.value = "";
        this.#find("");
      } else if (event.key === "ArrowDown" && first) first.focus();
      else if (event.key === "Enter" && first && field.value.trim() !== "") first.click();
      else return;
      event.preventDefault();
    });
    return field;
  }

  /** Hides the poses that a search does not find. */
  #find(search: string): void {
    this.#buttons.forEach((button, pose) => (button.hidden = !isFound(this.#names[pose], search)));
    for (const { element, poses } of this.#groups) {
      element.hidden = poses.every((pose) => this.#buttons[pose].hidden);
      if (search.trim() !== "") element.open = true; // shows what was found
    }
    const [first] = this.#shown();
    setText(this.#hint, first ? "" : `No pose has “${search.trim()}” in its name.`);
    if (first) this.#stop(first);
  }

  /** The visible pictures, in order. */
  #shown(): HTMLButtonElement[] {
    return this.#groups
      .filter(({ element }) => element.open && !element.hidden)
      .flatMap(({ poses }) => poses.map((pose) => this.#buttons[pose]))
      .filter((button) => !button.hidden);
  }

  /** Makes this picture the one that Tab reaches. */
  #stop(target: HTMLElement): void {
    if (!this.#buttons.includes(target as HTMLButtonElement)) return;
    for (const button of this.#buttons) button.tabIndex = button === target ? 0 : -1;
  }

  /** Left and right go to the neighbours, up and down to the nearest picture of another row. */
  #go(event: KeyboardEvent): void {
    const shown = this.#shown();
    const at = shown.indexOf(event.target as HTMLButtonElement);
    if (at < 0) return;
    const ends: Record<string, number> = { Home: 0, End: shown.length - 1 };
    const steps: Record<string, number> = { ArrowLeft: -1, ArrowRight: 1 };
    let next: HTMLButtonElement | undefined;
    if (event.key in ends) next = shown[ends[event.key]];
    else if (event.key in steps) next = shown[at + steps[event.key]];
    else if (event.key === "ArrowUp") next = inOtherRow(shown.slice(0, at).reverse(), shown[at]);
    else if (event.key === "ArrowDown") next = inOtherRow(shown.slice(at + 1), shown[at]);
    else return;
    event.preventDefault();
    if (next) next.focus();
    else if (event.key === "ArrowUp") this.search.focus();
  }
}

/** The button of the next row that is nearest across; `buttons` begin with the next one. */
function inOtherRow(
  buttons: readonly HTMLButtonElement[],
  from: HTMLButtonElement,
): HTMLButtonElement | undefined {
  const place = (button: HTMLButtonElement) => button.getBoundingClientRect();
  const { top, left } = place(from);
  const row = buttons.map(place).find((box) => Math.abs(box.top - top) > 1)?.top;
  if (row === undefined) return undefined;
  const away = (button: HTMLButtonElement) => Math.abs(place(button).left - left);
  return buttons
    .filter((button) => Math.abs(place(button).top - row) <= 1)
    .sort((a, b) => away(a) - away(b))[0];
}
