import type { Vector } from "../engine/messages.ts";
import { h } from "./dom.ts";

/** What a number in a field stands for. */
export interface Unit {
  readonly label: string;
  readonly sign: string;
  /** The field's number divided by the value. */
  readonly factor: number;
  readonly most: number;
}

export const DEGREES: Unit = { label: "Turn", sign: "°", factor: 180 / Math.PI, most: 180 };

/** Lengths as a share of the mesh's diagonal. */
export function shareOf(diagonal: number): Unit {
  return { label: "Travel", sign: "%", factor: 100 / diagonal, most: 1000 };
}

/** Half widths per axis: one field for all axes, or three. `act` gets valid values only. */
export function rangeFields(unit: Unit, value: Vector, act: (value: Vector) => void): HTMLElement {
  const fields = ["x", "y", "z"].map((axis, i) => {
    const input = h("input", { type: "number", min: 0, max: unit.most, step: "any", required: true });
    input.value = shown(value[i] * unit.factor);
    input.setAttribute("aria-label", `${unit.label} ${axis}, plus or minus`);
    input.addEventListener("input", take);
    return input;
  });
  const [first] = fields;
  const split = h("button", { type: "button", className: "axes", title: "One number for each axis" }, "xyz");
  let isSplit = value.some((entry) => entry !== value[0]);

  function take(): void {
    if (!isSplit) fields.forEach((field) => (field.value = first.value));
    const entries = fields.map((field) => field.valueAsNumber / unit.factor);
    if (fields.every((field) => field.validity.valid)) act([entries[0], entries[1], entries[2]]);
  }
  function show(): void {
    fields.slice(1).forEach((field) => (field.hidden = !isSplit));
    split.setAttribute("aria-pressed", String(isSplit));
    const name = isSplit ? `${unit.label} x` : unit.label;
    first.setAttribute("aria-label", `${name}, plus or minus`);
  }
  split.addEventListener("click", () => {
    isSplit = !isSplit;
    show();
    take();
  });
  show();
  const label = h("span", {}, `${unit.label} ±`);
  return h("div", { className: "range-fields" }, label, ...fields, h("span", {}, unit.sign), split);
}

function shown(value: number): string {
  return String(Number(value.toPrecision(3)));
}
