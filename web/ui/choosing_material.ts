import type { Workspace } from "../engine/messages.ts";
import type { Sampling } from "./choosing_sampling.ts";
import { h, section } from "./dom.ts";

const MOST_POISSON = 0.49; // tets lock beyond

/** The materials that the server offers, and those to begin with. */
export type Materials = Pick<Workspace, "materials" | "solid_material" | "shell_material" | "poisson">;

/** The material, and below it the parts of the body that are stiffer or softer. Changes `sampling`. After the body has
 * become a shell or a solid, `update` shows which materials it can have, and takes the usual one unless the user chose
 * another. */
export function materialPanel(sampling: Sampling, given: Materials, parts: HTMLElement) {
  const select = h("select", { "aria-label": "Material" });
  select.append(...given.materials.map(({ kind, title }) => h("option", { value: kind }, capital(title))));
  select.value = sampling.material;
  const ratio = h("input", { type: "number", min: 0, max: MOST_POISSON, step: "any" });
  const poisson = sampling.poisson ?? given.poisson;
  ratio.value = poisson === null ? "" : String(Number(poisson.toPrecision(4)));
  ratio.placeholder = "as in the file";
  ratio.addEventListener("input", () => {
    // if it is unchanged, the server keeps its own moduli
    const isGiven = ratio.value === "" || ratio.valueAsNumber === given.poisson;
    if (ratio.validity.valid) sampling.poisson = isGiven ? null : ratio.valueAsNumber;
  });
  const field = h("label", { className: "field" }, h("span", {}, "Poisson's ratio"), ratio);
  const usual = () => (sampling.thickness === null ? given.solid_material : given.shell_material);
  let last = usual();
  const update = () => {
    const isShell = sampling.thickness !== null;
    given.materials.forEach(({ makes_shells }, i) => (select.options[i].disabled = isShell && !makes_shells));
    if (select.selectedOptions[0]?.disabled || select.value === last)
      sampling.material = select.value = usual();
    last = usual();
    field.hidden = !given.materials.find(({ kind }) => kind === select.value)?.has_poisson;
    if (!field.hidden) return;
    sampling.poisson = null;
    ratio.value = given.poisson === null ? "" : String(given.poisson); // an invalid one must not stay
  };
  select.addEventListener("change", () => {
    sampling.material = select.value;
    update();
  });
  update();
  const element = section("Material", h("div", { className: "field" }, select), field, parts);
  return { element, update };
}

const capital = (title: string) => title.charAt(0).toUpperCase() + title.slice(1);
