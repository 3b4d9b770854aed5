import type { Container } from "./container.ts";
import type { Body, Material } from "./model.ts";
import { fileMaterial } from "./read_material.ts";
import { boundary, everywhere, type FileSurface } from "./read_surface.ts";
import { shellOf } from "./shell.ts";
import { diagonalOf, tetVolumes, vertexMasses } from "./tets.ts";

/** The body of a posing model's file: tets, or a shell. */
export interface FileBody {
  readonly rest: Float64Array;
  /** Tets; of a shell, triangles and hinges. */
  readonly elements: Int32Array;
  readonly masses: Float64Array;
  /** Of the elements. */
  readonly material: Material;
  readonly scales: Scales;
  /** Its surface, where the file has no other. */
  surface(): FileSurface;
}

/** Units for the termination tests, and the diagonal at rest. */
interface Scales {
  readonly valueScale: number | Body;
  readonly coordinateScale: number;
  readonly diagonal: number;
}

/** Reads the body; `material` is that of the file's problem. */
export function fileBody(container: Container, material: { readonly model: string }): FileBody {
  const [vertices] = container.shape("vertices", 2);
  const rest = container.doubles("vertices", vertices, 3);
  if (container.has("triangles")) return shellBody(container, rest, material);
  const [count] = container.shape("tets", 2);
  const elements = container.indices("tets", vertices, [count, 4]);
  const volumes = tetVolumes(rest, elements);
  const ofTets = fileMaterial(container, material, count);
  return {
    rest,
    elements,
    masses: vertexMasses(volumes, elements, vertices),
    material: ofTets,
    scales: scalesOfTets(ofTets, volumes, rest),
    surface: () => boundary(elements, vertices),
  };
}

function shellBody(container: Container, rest: Float64Array, material: { readonly model: string }): FileBody {
  const [count] = container.shape("triangles", 2);
  const [numbers] = container.shape("thickness", 1);
  const triangles = container.indices("triangles", rest.length / 3, [count, 3]);
  const thickness = container.doubles("thickness", numbers === 1 ? 1 : count);
  const shell = shellOf(rest, triangles, thickness, fileMaterial(container, material, count));
  const diagonal = diagonalOf(rest);
  return {
    rest,
    elements: shell.elements,
    masses: shell.masses,
    material: shell.material,
    scales: scales(shell.bendingScale / diagonal ** 2, shell.volumes, diagonal),
    surface: () => everywhere(triangles, rest.length / 3),
  };
}

/** The unit of energy is that of a strain of 10 %. */
export function scalesOfTets(material: Material, volumes: Float64Array, rest: Float64Array): Scales {
  return scales({ volumes, material }, volumes, diagonalOf(rest));
}

/** The unit of coordinates is a displacement by a tenth of the diagonal. */
function scales(valueScale: number | Body, volumes: Float64Array, diagonal: number): Scales {
  const volume = volumes.reduce((sum, one) => sum + one, 0);
  return { valueScale, coordinateScale: 0.1 * diagonal * Math.sqrt(volume), diagonal };
}
