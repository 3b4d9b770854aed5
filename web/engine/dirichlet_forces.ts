import { triangleHats } from "./triangle_hats.ts";
import { oneRings, type RigidSurface } from "./vertex_stars.ts";

/** The gradient of a surface's Dirichlet energy, the sum over triangles of stiffness * area * |grad u|^2, at some vertices. */
export class DirichletForces {
  /** The vertices that a force depends on, and by how much. */
  readonly #rows: readonly (readonly (readonly [number, number])[])[];

  constructor(shape: Float64Array, { triangles, stiffness }: RigidSurface, vertices: Int32Array) {
    const { areas, gradients } = triangleHats(shape, triangles);
    this.#rows = oneRings(triangles, vertices, shape.length / 3).map((ring, row) => {
      const sums = new Map<number, number>();
      for (const triangle of Array.from(ring.triangles)) {
        const corners = triangles.subarray(3 * triangle, 3 * triangle + 3);
        const hats = gradients.subarray(9 * triangle, 9 * triangle + 9);
        const own = 3 * corners.indexOf(vertices[row]);
        corners.forEach((vertex, k) => {
          const product =
            hats[own] * hats[3 * k] + hats[own + 1] * hats[3 * k + 1] + hats[own + 2] * hats[3 * k + 2];
          const coupling = 2 * stiffness[triangle] * areas[triangle] * product;
          sums.set(vertex, (sums.get(vertex) ?? 0) + coupling);
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
