import { triangleNormals } from "./triangles.ts";
import { oneRings, type RigidSurface } from "./vertex_stars.ts";

/** The gradient of a surface's Dirichlet energy, the sum over triangles of stiffness * area * |grad u|^2, at some vertices. */
export class DirichletForces {
  /** The vertices that a force depends on, and by how much. */
  readonly #rows: readonly (readonly (readonly [number, number])[])[];

  constructor(shape: Float64Array, { triangles, stiffness }: RigidSurface, vertices: Int32Array) {
    const normals = triangleNormals(shape, triangles); // as long as twice the areas
    this.#rows = oneRings(triangles, vertices, shape.length / 3).map((ring, row) => {
      const sums = new Map<number, number>();
      for (const triangle of Array.from(ring.triangles)) {
        const corners = triangles.subarray(3 * triangle, 3 * triangle + 3);
        // a hat's gradient is its opposite edge turned by a right angle, over twice the area
        const opposite = [0, 1, 2].map((k) =>
          [0, 1, 2].map(
            (axis) => shape[3 * corners[(k + 2) % 3] + axis] - shape[3 * corners[(k + 1) % 3] + axis],
          ),
        );
        const own = opposite[corners.indexOf(vertices[row])];
        const twice = Math.hypot(...normals.subarray(3 * triangle, 3 * triangle + 3));
        corners.forEach((vertex, k) => {
          const product = own[0] * opposite[k][0] + own[1] * opposite[k][1] + own[2] * opposite[k][2];
          sums.set(vertex, (sums.get(vertex) ?? 0) + (stiffness[triangle] * product) / twice);
        });
      }
      return [...sums];
    });
  }

  /** Three numbers per vertex, at displacements of the whole surface. */
  at(displacements: ArrayLike<number>): Float64Array {
    const forces = new Float64Array(3 * this.#rows.length);
    this.#rows.forEach((row, i) => {
      for (const [vertex, coupling] of row)
        for (let axis = 0; axis < 3; axis++)
          forces[3 * i + axis] += coupling * displacements[3 * vertex + axis];
    });
    return forces;
  }
}
