import type { Container } from "./container.ts";
import type { Material } from "./model.ts";

/** The material of all tets of a model file, out of its entry "material": the name, and moduli by name. */
export function fileMaterial(
  container: Container,
  { model, ...moduli }: { readonly model: string },
  tets: number,
): Material {
  if (container.has("material_moduli")) return readMaterial(container, "material_moduli", model, tets);
  return { kind: model, rows: 1, moduli };
}

/** Rows of moduli in an array of that name: one for all tets, or one per tet. */
export function readMaterial(container: Container, name: string, kind: string, tets?: number): Material {
  const [rows, count] = container.shape(name, 2);
  if (rows !== 1 && tets !== undefined && rows !== tets)
    throw new RangeError(`there are ${rows} rows of moduli for ${tets} tets`);
  return { kind, rows, moduli: container.doubles(name, rows, count) };
}

/** The moduli of a triangle. `names` has all moduli of the density, in its order. */
export function moduliOf({ moduli, rows }: Material, names: readonly string[], triangle: number): number[] {
  if (!(moduli instanceof Float64Array)) return names.map((name) => Number(moduli[name]));
  const start = rows === 1 ? 0 : names.length * triangle;
  return [...moduli.subarray(start, start + names.length)];
}

/** The material of some tets, in their order. */
export function materialOfTets(material: Material, tets: Int32Array): Material {
  const { kind, rows, moduli, shell } = material;
  if (!(moduli instanceof Float64Array) || rows === 1) return material;
  const taken = (numbers: Float64Array) => {
    const count = numbers.length / rows;
    const chosen = new Float64Array(count * tets.length);
    tets.forEach((tet, i) => chosen.set(numbers.subarray(count * tet, count * (tet + 1)), count * i));
    return chosen;
  };
  const ofTets = { kind, rows: tets.length, moduli: taken(moduli) };
  if (!shell) return ofTets;
  return { ...ofTets, shell: { points: taken(shell.points), products: taken(shell.products) } };
}
