import type { Workspace } from "../engine/messages.ts";
import type { Sampling } from "./choosing_sampling.ts";
import { choice, h, section } from "./dom.ts";

type Form = "solid" | "shell";

/** What the server says of the surface. */
export type Forms = Pick<Workspace, "usual_thickness" | "is_filled" | "is_open" | "has_surface" | "diagonal">;

const OPEN =
  "The surface is open, so it is a shell: a thin body that stays as it is. Choose Solid to close and fill it.";
const SHELL = "A thin body: the surface stays as it is. Thickness is in its unit of length";

/** Solid or shell, and the shell's thickness. Changes `sampling`; `fill` is for a solid that has no tets yet. Empty for
 * meshes that came as tets. */
export function bodyPanel(
  sampling: Sampling,
  given: Forms,
  fill: () => void,
  onChange: () => void,
): HTMLElement[] {
  const usual = given.usual_thickness ?? null;
  if (usual === null) return [];
  const thickness = h("input", { type: "number", min: 1e-9 * given.diagonal, step: "any", required: true });
  thickness.value = String(sampling.thickness ?? usual);
  const field = h("label", { className: "field" }, h("span", {}, "Thickness"), thickness);
  const hint = h("p", { className: "hint", id: "body-hint", role: "status" });
  const update = () => {
    field.hidden = sampling.thickness === null;
    thickness.disabled = field.hidden; // a hidden number need not be valid
    const share = `${Number(((100 * (sampling.thickness ?? 0)) / given.diagonal).toPrecision(2))} %`;
    hint.textContent = field.hidden ? "" : given.is_open ? OPEN : `${SHELL}, now ${share} of the diagonal.`;
  };
  const take = (value: number | null) => {
    sampling.thickness = value;
    update();
    onChange();
  };
  thickness.addEventListener("input", () => {
    if (thickness.validity.valid) take(thickness.valueAsNumber);
  });
  const options: [Form, string][] = [["shell", "Shell"]];
  if (given.is_filled || given.has_surface) options.unshift(["solid", "Solid"]);
  const chosen = sampling.thickness === null ? "solid" : "shell";
  const forms = choice<Form>("Body", options, chosen, (form) => {
    if (form === "shell") take(thickness.validity.valid ? thickness.valueAsNumber || usual : usual);
    else if (given.is_filled) take(null);
    else {
      forms.set("shell"); // until there are tets
      fill();
    }
  });
  update();
  return [section("Body", forms.element, field, hint)];
}
