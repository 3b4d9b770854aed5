import type { Material } from "./model.ts";
import { moduliOf } from "./read_material.ts";
import { hingesOf, triangleAreas } from "./triangles.ts";

/** A shell at rest, as ShellMesh and ShellMaterial of the Python package have it. */
export interface Shell {
  /** Triangles with their last corner twice, and after them hinges: four corners each. */
  readonly elements: Int32Array;
  /** The material of the elements. */
  readonly material: Material;
  /** Unit of energy: that of bending by a curvature of sqrt(2) over the diagonal, times its square. */
  readonly bendingScale: number;
}

/** The shell of triangles with one shape at rest, or several that are blended; the first one is that of the material.
 * `thickness` has one number per triangle. */
export function shellOf(
  shapes: readonly Float64Array[],
  triangles: Int32Array,
  thickness: Float64Array,
  material: Material,
): Shell {
  const count = triangles.length / 3;
  const { hinges, sides } = hingesOf(triangles);
  const areas = shapes.map((shape) => triangleAreas(shape, triangles));
  const rigidities = new Float64Array(count);
  const elements = new Int32Array(4 * count + hinges.length);
  const moduli = new Float64Array((3 * elements.length) / 4);
  let bendingScale = 0;
  for (let t = 0; t < count; t++) {
    const thick = thickness[t];
    const [lam, mu] = moduliOf(material, ["lam", "mu"], t);
    const plane = (2 * lam * mu) / (lam + 2 * mu); // plane stress
    rigidities[t] = ((2 * mu + plane) * thick ** 3) / 12;
    bendingScale += rigidities[t] * areas[0][t];
    moduli.set([mu * thick, plane * thick, 0], 3 * t);
  }
  elements.set(withLastTwice(triangles));
  elements.set(hinges, 4 * count);
  const products = new Float64Array(elements.length / 4);
  for (let hinge = 0; hinge < hinges.length / 4; hinge++) {
    const [a, b] = sides.subarray(2 * hinge, 2 * hinge + 2);
    const [first, second] = [areas[0][a], areas[0][b]];
    moduli[3 * (count + hinge) + 2] = (first * rigidities[a] + second * rigidities[b]) / (first + second);
    const logarithms = areas.reduce((sum, ofPose) => sum + Math.log(4 * ofPose[a] * ofPose[b]), 0);
    products[count + hinge] = Math.exp(logarithms / areas.length);
  }
  const points = pointsOf(shapes[0], elements);
  const ofElements = { kind: `shell-${material.kind}`, rows: elements.length / 4, moduli };
  return { elements, material: { ...ofElements, shell: { points, products } }, bendingScale };
}

/** Triangles as elements of four corners: their last one twice. */
export function withLastTwice(triangles: Int32Array): Int32Array {
  return Int32Array.from(
    { length: (4 * triangles.length) / 3 },
    (_, i) => triangles[3 * (i >> 2) + Math.min(i & 3, 2)],
  );
}

/** Where the corners of elements are, elements x 4 x 3. */
export function pointsOf(shape: Float64Array, elements: Int32Array): Float64Array<ArrayBuffer> {
  return Float64Array.from(
    { length: 3 * elements.length },
    (_, i) => shape[3 * elements[Math.floor(i / 3)] + (i % 3)],
  );
}
