import { triangleNormals } from "./triangles.ts";

/** The triangles of a shape. */
export interface TriangleHats {
  readonly areas: Float64Array;
  /** Unit normals, 3 numbers per triangle. */
  readonly units: Float64Array;
  /** Gradients of the hat functions of its corners, 9 numbers per triangle. */
  readonly gradients: Float64Array;
}

export function triangleHats(shape: Float64Array, triangles: Int32Array): TriangleHats {
  const units = triangleNormals(shape, triangles); // as long as twice the areas, at first
  const areas = new Float64Array(triangles.length / 3);
  const gradients = new Float64Array(3 * triangles.length);
  for (let t = 0; t < areas.length; t++) {
    const twice = Math.hypot(units[3 * t], units[3 * t + 1], units[3 * t + 2]);
    areas[t] = twice / 2;
    for (let axis = 0; axis < 3; axis++) units[3 * t + axis] /= twice;
    const [a, b, c] = [units[3 * t], units[3 * t + 1], units[3 * t + 2]];
    for (let corner = 0; corner < 3; corner++) {
      // the opposite edge, turned by a right angle, over twice the area
      const from = 3 * triangles[3 * t + ((corner + 1) % 3)];
      const to = 3 * triangles[3 * t + ((corner + 2) % 3)];
      const x = shape[to] - shape[from];
      const y = shape[to + 1] - shape[from + 1];
      const z = shape[to + 2] - shape[from + 2];
      const at = 9 * t + 3 * corner;
      gradients[at] = (b * z - c * y) / twice;
      gradients[at + 1] = (c * x - a * z) / twice;
      gradients[at + 2] = (a * y - b * x) / twice;
    }
  }
  return { areas, units, gradients };
}
