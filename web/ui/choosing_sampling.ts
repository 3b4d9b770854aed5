import type { Vector, Workspace } from "../engine/messages.ts";
import { h, section } from "./dom.ts";
import { DEGREES, rangeFields, shareOf } from "./range_fields.ts";

/** What a model is computed with, besides the handles. */
export interface Sampling {
  translation: Vector;
  angle: Vector;
  samples: number;
  dimension: number;
  seed: number;
  stiffness: number;
  material: string;
  /** Null: as the server has it. */
  poisson: number | null;
}

export type CommonRanges = () => Pick<Sampling, "translation" | "angle">;

export function samplingOf(given: Workspace): Sampling {
  const { translation, angle, samples, dimension, seed, stiffness, material } = given;
  return { translation, angle, samples, dimension, seed, stiffness, material, poisson: null };
}

/** How far handles move, how many samples; folded under one line that tells it. Changes `sampling`. */
export function samplingPanel(sampling: Sampling, diagonal: number): HTMLElement {
  const told = h("span", { className: "told" });
  const tell = () => {
    const percent = shareOf(diagonal).factor * Math.max(...sampling.translation);
    const degrees = DEGREES.factor * Math.max(...sampling.angle);
    told.textContent = `±${percent.toFixed(0)} %, ±${degrees.toFixed(0)}°, ${sampling.samples} samples`;
  };
  tell();
  const number = (
    label: string,
    limits: { min: number; max: number; step: number | "any" },
    key: "samples" | "dimension" | "stiffness",
  ) => {
    const input = h("input", { type: "number", required: true, ...limits });
    input.value = String(Number(sampling[key].toPrecision(4)));
    input.addEventListener("input", () => {
      if (!input.validity.valid) return;
      sampling[key] = input.valueAsNumber;
      tell();
    });
    return h("label", { className: "field" }, h("span", {}, label), input);
  };
  const set = (key: "translation" | "angle") => (value: Vector) => {
    sampling[key] = value;
    tell();
  };
  return section(
    "Motions and samples",
    h(
      "details",
      {},
      h("summary", {}, told),
      h(
        "p",
        { className: "hint" },
        "How far handles move from rest; travel is a share of the body's diagonal.",
      ),
      rangeFields(shareOf(diagonal), sampling.translation, set("translation")),
      rangeFields(DEGREES, sampling.angle, set("angle")),
      number("Samples", { min: 8, max: 20_000, step: 1 }, "samples"),
      number("Dimensions", { min: 1, max: 100, step: 1 }, "dimension"),
      number("Handles' stiffness", { min: 1e-6, max: 1e9, step: "any" }, "stiffness"),
    ),
  );
}
