import { eulerOfRotation, rotationOfEuler, type Motion } from "../engine/index.ts";
import { h } from "./dom.ts";

const DEGREES = 180 / Math.PI;
const AXES = ["x", "y", "z"] as const;

/** Six fields with the motion of the selected handle: lengths of the mesh and degrees. `act` gets what is typed. */
export class MotionFields {
  readonly element: HTMLElement;
  readonly #shift: readonly HTMLInputElement[];
  readonly #turn: readonly HTMLInputElement[];
  readonly #step: number;

  constructor(diagonal: number, act: (motion: Motion) => void) {
    const take = () => {
      const numbers = [...this.#turn, ...this.#shift].map((field) => field.valueAsNumber);
      if (!numbers.every(Number.isFinite)) return;
      const [a, b, c, x, y, z] = numbers;
      const rotation = rotationOfEuler([a / DEGREES, b / DEGREES, c / DEGREES]);
      act({ rotation, translation: [x, y, z] });
    };
    const row = (label: string, unit: string, step: number) =>
      AXES.map((axis) => {
        const field = h("input", { type: "number", step: "any", required: true });
        field.setAttribute("aria-label", `${label} ${axis}, ${unit}`);
        field.addEventListener("change", take);
        field.addEventListener("keydown", (event) => {
          if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
          event.preventDefault();
          const sign = event.key === "ArrowUp" ? 1 : -1;
          field.value = rounded(field.valueAsNumber + sign * step * (event.shiftKey ? 10 : 1), step / 100);
          take();
        });
        return field;
      });
    this.#step = 10 ** Math.floor(Math.log10(diagonal / 100));
    this.#shift = row("Move", "in the unit of the mesh", this.#step);
    this.#turn = row("Turn", "degrees", 1);
    this.element = h(
      "div",
      { className: "motion-fields", hidden: true },
      h("span", {}, "Move"),
      ...this.#shift,
      h("span", {}, ""),
      h("span", {}, "Turn"),
      ...this.#turn,
      h("span", {}, "°"),
    );
  }

  /** Shows a motion, or hides the fields for null. A field that has the focus keeps what is typed. */
  show(motion: Motion | null): void {
    if (this.element.hidden !== (motion === null)) this.element.hidden = motion === null;
    if (!motion) return;
    const turns = eulerOfRotation(motion.rotation).map((angle) => DEGREES * angle);
    [...this.#shift, ...this.#turn].forEach((field, k) => {
      const text = k < 3 ? rounded(motion.translation[k], this.#step / 100) : rounded(turns[k - 3], 0.01);
      if (field !== document.activeElement && field.value !== text) field.value = text;
    });
  }
}

/** A multiple of a unit, without the digits of binary fractions. */
const rounded = (x: number, unit: number) =>
  String(Number((Math.round(x / unit) * unit).toPrecision(12)) || 0);
