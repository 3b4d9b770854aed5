import type { Vector, Workspace } from "../engine/messages.ts";
import { h, section } from "./dom.ts";
import { DEGREES, rangeFields, shareOf } from "./range_fields.ts";

/** What a model is computed with, besides the handles. */
export interface Sampling {
  translation: Vector;
  angle: Vector;
  /** The median error of unseen motions that is good enough. */
  target_error: number;
  /** Null: as many as usual. */
  most_samples: number | null;
  seed: number;
  stiffness: number;
  material: string;
  /** Null: the server's own. */
  poisson: number | null;
  /** Thickness of the shell; null: a solid. */
  thickness: number | null;
}

export type CommonRanges = () => Pick<Sampling, "translation" | "angle">;

export function samplingOf(given: Workspace): Sampling {
  const { translation, angle, target_error, most_samples, seed, stiffness, material } = given;
  const poisson = given.own_poisson ?? null;
  return {
    translation,
    angle,
    target_error,
    most_samples: most_samples ?? null,
    seed,
    stiffness,
    material,
    poisson,
    thickness: given.thickness ?? null,
  };
}

/** How far handles move, how accurate the model is; folded under a line that sums it up. Changes `sampling`. */
export function samplingPanel(sampling: Sampling, diagonal: number): HTMLElement {
  const summary = h("span", { className: "detail" });
  const showSummary = () => {
    const percent = shareOf(diagonal).factor * Math.max(...sampling.translation);
    const degrees = DEGREES.factor * Math.max(...sampling.angle);
    const error = 100 * sampling.target_error;
    summary.textContent = `±${percent.toFixed(0)} %, ±${degrees.toFixed(0)}°, error ${Number(error.toPrecision(2))} %`;
  };
  showSummary();
  const number = (
    label: string,
    limits: Partial<HTMLInputElement>,
    value: number | null,
    take: (value: number | null) => void,
  ) => {
    const input = h("input", { type: "number", required: value !== null, ...limits });
    if (value !== null) input.value = String(Number(value.toPrecision(4)));
    input.addEventListener("input", () => {
      if (!input.validity.valid) return;
      take(input.value === "" ? null : input.valueAsNumber);
      showSummary();
    });
    return h("label", { className: "field" }, h("span", {}, label), input);
  };
  const set = (key: "translation" | "angle") => (value: Vector) => {
    sampling[key] = value;
    showSummary();
  };
  return section(
    "Motions and accuracy",
    h(
      "details",
      {},
      h("summary", {}, summary),
      h(
        "p",
        { className: "hint" },
        "How far handles move from rest. Travel is a share of the body's diagonal.",
      ),
      rangeFields(shareOf(diagonal), sampling.translation, set("translation")),
      rangeFields(DEGREES, sampling.angle, set("angle")),
      number(
        "Error of unseen motions, %",
        { min: "0.01", max: "50", step: "any" },
        100 * sampling.target_error,
        (value) => (sampling.target_error = value! / 100),
      ),
      number(
        "Samples, at most",
        { min: "20", max: "20000", step: "1", placeholder: "as needed" },
        sampling.most_samples,
        (value) => (sampling.most_samples = value),
      ),
      number(
        "Handles' stiffness",
        { min: "1e-6", max: "1e9", step: "any" },
        sampling.stiffness,
        (value) => (sampling.stiffness = value!),
      ),
    ),
  );
}
