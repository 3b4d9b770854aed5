import type { WeightEnds } from "../engine/index.ts";
import { h, mark } from "./dom.ts";
import { MOST_CHOSEN, type PoseChoice } from "./pose_choice.ts";
import { sliderEnds } from "./slider_ends.ts";

export interface WeightActions {
  /** A weight between the ends for the pose at a place of the choice. */
  weigh(place: number, weight: number): void;
  remove(pose: number): void;
}

/** The weights of the chosen poses: a slider and a number for each, and a button that takes it away.
 *
 * The number of rows is fixed and unused rows are hidden, so that the focus stays in its row when others come and go. */
export class WeightRows {
  readonly element: HTMLElement;
  readonly #names: readonly string[];
  readonly #rows: ReturnType<typeof weightRow>[];
  #choice: PoseChoice = { poses: [], weights: [] };

  constructor(names: readonly string[], acts: WeightActions) {
    this.#names = names;
    this.#rows = Array.from({ length: MOST_CHOSEN }, (_, place) =>
      weightRow(
        (weight) => acts.weigh(place, weight),
        () => acts.remove(this.#choice.poses[place]),
      ),
    );
    this.element = h("div", {}, ...this.#rows.map(({ element }) => element));
  }

  /** How far a row's weight may go. */
  extend(place: number, ends: WeightEnds): void {
    this.#rows[place].extend(ends);
  }

  /** `pictures` are addresses by pose; those that are not made yet are missing. */
  show(choice: PoseChoice, pictures: readonly (string | undefined)[]): void {
    this.#choice = choice;
    const last = choice.poses.length - 1;
    this.#rows.forEach(({ element, remove, show }, place) => {
      const hadFocus = element.contains(document.activeElement);
      element.hidden = place > last;
      if (place <= last) {
        const pose = choice.poses[place];
        show(this.#names[pose], pictures[pose], choice.weights[place]);
        remove.disabled = last === 0;
      }
      if (!hadFocus || (place <= last && !remove.disabled)) return;
      // the element with the focus is gone
      const { input, remove: button } = this.#rows[Math.min(place, last)];
      (last === 0 ? input : button).focus();
    });
  }
}

function weightRow(weigh: (weight: number) => void, remove: () => void) {
  const picture = h("img", { alt: "", width: 26, height: 26 });
  const name = h("span");
  const number = h("input", { type: "number", min: 0, max: 100, step: "any", required: true });
  const input = h("input", { type: "range", min: 0, max: 1, step: 0.001 });
  const button = h("button", { type: "button", className: "small bare", onclick: remove }, "✕");
  let isTyped = false; // keeps a number that is being typed
  input.addEventListener("input", () => weigh(input.valueAsNumber));
  number.addEventListener("input", () => (isTyped = true));
  number.addEventListener("change", () => {
    isTyped = false;
    if (number.validity.valid) weigh(number.valueAsNumber / 100);
    else showNumber();
  });
  number.addEventListener("blur", () => (isTyped = false));
  const element = h(
    "div",
    { className: "weight" },
    picture,
    name,
    h("label", {}, number, "%"),
    button,
    input,
  );
  const ends = sliderEnds(input);
  element.append(ends.element);
  const extend = (own: WeightEnds) => {
    ends.set(own);
    mark(number, "min", Math.round(100 * own[0]));
    mark(number, "max", Math.round(100 * own[1]));
  };
  let shown = 0;
  const showNumber = () => (number.value = String(Math.round(1000 * shown) / 10));
  const show = (pose: string, address: string | undefined, weight: number) => {
    if (name.textContent !== pose) {
      name.textContent = name.title = pose;
      mark(input, "aria-label", pose);
      mark(number, "aria-label", `Weight of ${pose} in percent`);
      mark(button, "aria-label", `Take ${pose} away`);
      button.title = "Take away";
    }
    if (address && picture.getAttribute("src") !== address) picture.src = address;
    picture.style.visibility = address ? "" : "hidden";
    input.value = String(weight);
    shown = weight;
    mark(input, "aria-valuetext", `${Math.round(100 * weight)} %`);
    if (!isTyped) showNumber();
  };
  return { element, input, remove: button, extend, show };
}
