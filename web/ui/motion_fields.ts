import { eulerOfRotation, rotationOfEuler, type Motion } from "../engine/index.ts";
import { h } from "./dom.ts";

const DEGREES = 180 / Math.PI;
const AXES = ["x", "y", "z"] as const;
/** The farthest motions that can be typed: diagonals of the mesh, and degrees. Solves far beyond are not finite. */
const [FARTHEST, MOST_DEGREES] = [1000, 3600];

/** Six fields with the motion of the selected handle: lengths of the mesh and degrees. `act` gets what is typed, and
 * the handle that it was typed for. */
export class MotionFields {
  readonly element: HTMLElement;
  readonly #fields: readonly HTMLInputElement[];
  readonly #step: number;
  /** What is shown, in full precision: three lengths and three angles. */
  #values: readonly number[] = [0, 0, 0, 0, 0, 0];
  #handle = -1;

  constructor(diagonal: number, act: (handle: number, motion: Motion) => void) {
    this.#step = 10 ** Math.floor(Math.log10(diagonal / 100));
    const take = (place: number, field: HTMLInputElement) => {
      // a field never keeps what is no number, or one that is too large
      if (!field.validity.valid) return this.#write(place);
      const [x, y, z, a, b, c] = this.#values.map((value, k) => (k === place ? field.valueAsNumber : value));
      const rotation = rotationOfEuler([a / DEGREES, b / DEGREES, c / DEGREES]);
      act(this.#handle, { rotation, translation: [x, y, z] });
    };
    const row = (first: number, label: string, unit: string, step: number, most: number) =>
      AXES.map((axis, k) => {
        const place = first + k;
        const field = h("input", { type: "number", min: -most, max: most, step: "any", required: true });
        field.setAttribute("aria-label", `${label} ${axis}, ${unit}`);
        field.addEventListener("change", () => take(place, field));
        field.addEventListener("blur", () => this.#write(place));
        field.addEventListener("keydown", (event) => {
          if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
          event.preventDefault();
          const from = field.validity.valid ? field.valueAsNumber : this.#values[place];
          const sign = event.key === "ArrowUp" ? 1 : -1;
          field.value = rounded(from + sign * step * (event.shiftKey ? 10 : 1), step / 100);
          take(place, field);
        });
        return field;
      });
    const shift = row(0, "Move", "in the unit of the mesh", this.#step, FARTHEST * diagonal);
    const turn = row(3, "Turn", "degrees", 1, MOST_DEGREES);
    this.#fields = [...shift, ...turn];
    this.element = h(
      "div",
      { className: "motion-fields", hidden: true },
      h("span", {}, "Move"),
      ...shift,
      h("span", {}, ""),
      h("span", {}, "Turn"),
      ...turn,
      h("span", {}, "°"),
    );
  }

  /** Shows the motion of a handle, or hides the fields for null. A field that has the focus keeps what is typed, until
   * another handle is selected. */
  show(handle: number, motion: Motion | null): void {
    if (handle !== this.#handle) this.#fields.find((field) => field === document.activeElement)?.blur();
    this.#handle = handle;
    if (this.element.hidden !== (motion === null)) this.element.hidden = motion === null;
    if (!motion) return;
    const turns = eulerOfRotation(motion.rotation).map((angle) => DEGREES * angle);
    this.#values = [...motion.translation, ...turns];
    this.#fields.forEach((field, place) => {
      if (field !== document.activeElement) this.#write(place);
    });
  }

  #write(place: number): void {
    const text = rounded(this.#values[place], place < 3 ? this.#step / 100 : 0.01);
    if (this.#fields[place].value !== text) this.#fields[place].value = text;
  }
}

/** A multiple of a unit, without the digits of binary fractions. */
const rounded = (x: number, unit: number) =>
  String(Number((Math.round(x / unit) * unit).toPrecision(12)) || 0);
