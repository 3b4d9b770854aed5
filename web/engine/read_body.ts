import type { Container } from "./container.ts";
import { vertexMasses, type Mass } from "./mass.ts";
import type { Body, Material } from "./model.ts";
import { fileMaterial, moduliOf } from "./read_material.ts";
import { boundary, everywhere, type FileSurface } from "./read_surface.ts";
import { pointsOf, shellOf, withLastTwice } from "./shell.ts";
import { diagonalOf, tetVolumes } from "./tets.ts";
import { triangleAreas } from "./triangles.ts";
import type { RigidSurface } from "./vertex_stars.ts";

/** The body of a model file: tets, or a shell. */
export interface FileBody {
  /** The shape at rest, or all poses. */
  readonly shapes: readonly Float64Array[];
  /** Tets; triangles and hinges of a shell; or triangles alone of an as-rigid-as-possible surface. */
  readonly elements: Int32Array;
  /** The material of the elements. */
  readonly material: Material;
  /** An as-rigid-as-possible surface, whose cubature has stars of its vertices; null for others. */
  readonly rigid: RigidSurface | null;
  readonly scales: Scales;
  /** Masses of the vertices at rest, or in the first pose. */
  readonly masses: Float64Array;
  /** Volumes at another shape. */
  massAt(shape: Float64Array): Mass;
  /** Its surface, where the file has no other. */
  surface(): FileSurface;
}

/** Units for the termination tests, and the diagonal at rest. */
interface Scales {
  readonly valueScale: number | Body;
  readonly coordinateScale: number;
  readonly diagonal: number;
}

interface FileMaterial {
  readonly model: string;
}

/** Reads the body with these shapes at rest; `material` is that of the file's problem. */
export function fileBody(
  container: Container,
  shapes: readonly Float64Array[],
  material: FileMaterial,
): FileBody {
  return container.has("triangles")
    ? shellBody(container, shapes, material)
    : tetBody(container, shapes, material);
}

function tetBody(container: Container, shapes: readonly Float64Array[], material: FileMaterial): FileBody {
  const [[rest], vertices] = [shapes, shapes[0].length / 3];
  const [count] = container.shape("tets", 2);
  const tets = container.indices("tets", vertices, [count, 4]);
  const massAt = (shape: Float64Array): Mass => ({
    cells: tets,
    corners: 4,
    volumes: tetVolumes(shape, tets),
  });
  const [mass, ofTets] = [massAt(rest), fileMaterial(container, material, count)];
  return {
    shapes,
    elements: tets,
    material: ofTets,
    rigid: null,
    // the unit of energy is that of a strain of 10 %
    scales: scales({ volumes: mass.volumes, material: ofTets }, mass.volumes, diagonalOf(rest)),
    masses: vertexMasses(mass, vertices),
    massAt,
    surface: () => boundary(tets, vertices),
  };
}

function shellBody(container: Container, shapes: readonly Float64Array[], material: FileMaterial): FileBody {
  const [[rest], vertices] = [shapes, shapes[0].length / 3];
  const [count] = container.shape("triangles", 2);
  const [numbers] = container.shape("thickness", 1);
  const triangles = container.indices("triangles", vertices, [count, 3]);
  const given = container.doubles("thickness", numbers === 1 ? 1 : count);
  const thickness = numbers === 1 ? new Float64Array(count).fill(given[0]) : given;
  const massAt = (shape: Float64Array): Mass => ({
    cells: triangles,
    corners: 3,
    volumes: triangleAreas(shape, triangles).map((area, t) => area * thickness[t]),
  });
  const [mass, ofTriangles] = [massAt(rest), fileMaterial(container, material, count)];
  const { bendingScale, ...body } =
    ofTriangles.kind === "arap"
      ? rigidBody(rest, triangles, thickness, ofTriangles)
      : { ...shellOf(shapes, triangles, thickness, ofTriangles), rigid: null };
  const diagonal = diagonalOf(rest);
  return {
    shapes,
    ...body,
    scales: scales(bendingScale / diagonal ** 2, mass.volumes, diagonal),
    masses: vertexMasses(mass, vertices),
    massAt,
    surface: () => everywhere(triangles, vertices),
  };
}

function rigidBody(rest: Float64Array, triangles: Int32Array, thickness: Float64Array, material: Material) {
  const stiffness = thickness.map((thick, t) => thick * moduliOf(material, ["mu"], t)[0]);
  // equilateral triangles bend as a plate of stiffness sqrt(3/4) stiffness * area
  const bendingScale = triangleAreas(rest, triangles).reduce(
    (sum, area, t) => sum + Math.sqrt(0.75) * stiffness[t] * area ** 2,
    0,
  );
  const elements = withLastTwice(triangles);
  const moduli = Float64Array.from({ length: 3 * stiffness.length }, (_, i) =>
    i % 3 ? 0 : stiffness[i / 3],
  );
  const shell = { points: pointsOf(rest, elements), products: new Float64Array(stiffness.length) };
  const ofTriangles = { kind: "shell-arap", rows: stiffness.length, moduli, shell };
  return { elements, material: ofTriangles, rigid: { triangles, stiffness }, bendingScale };
}

/** The unit of coordinates is a displacement by a tenth of the diagonal. */
function scales(valueScale: number | Body, volumes: Float64Array, diagonal: number): Scales {
  const volume = volumes.reduce((sum, one) => sum + one, 0);
  return { valueScale, coordinateScale: 0.1 * diagonal * Math.sqrt(volume), diagonal };
}
