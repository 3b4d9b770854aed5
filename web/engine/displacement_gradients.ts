/** Displacement gradients of modes in single tets: tets x 9 x modes, entry 3 a + b is d u_a / d x_b.
 *
 * Modes are rows of `rest.length` numbers. As snapspace/reduction/displacement_gradients.py. */
export function displacementGradients(
  rest: Float64Array,
  tets: Int32Array,
  modes: Float64Array,
  chosen: Int32Array,
): Float32Array<ArrayBuffer> {
  const count = modes.length / rest.length;
  const rows = new Float32Array(9 * count * chosen.length);
  chosen.forEach((tet, index) => {
    const corners = tets.subarray(4 * tet, 4 * tet + 4);
    const hats = hatGradients(rest, corners);
    for (let mode = 0; mode < count; mode++)
      for (let a = 0; a < 3; a++) {
        const at = (corner: number) => modes[mode * rest.length + 3 * corners[corner] + a];
        // differences first: sums over the four corners would lose digits on slivers
        const [u, v, w] = [at(1) - at(0), at(2) - at(0), at(3) - at(0)];
        for (let b = 0; b < 3; b++)
          rows[(9 * index + 3 * a + b) * count + mode] = u * hats[b] + v * hats[3 + b] + w * hats[6 + b];
      }
  });
  return rows;
}

/** Gradients of the hat functions of corners 1, 2 and 3 of a tet, one after the other; positions x0 y0 z0 x1 ... */
export function hatGradients(positions: ArrayLike<number>, corners: ArrayLike<number>): number[] {
  const edge = (corner: number, axis: number) =>
    positions[3 * corners[corner] + axis] - positions[3 * corners[0] + axis];
  const [ax, ay, az] = [edge(1, 0), edge(1, 1), edge(1, 2)];
  const [bx, by, bz] = [edge(2, 0), edge(2, 1), edge(2, 2)];
  const [cx, cy, cz] = [edge(3, 0), edge(3, 1), edge(3, 2)];
  const [ux, uy, uz] = [by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx];
  const [vx, vy, vz] = [cy * az - cz * ay, cz * ax - cx * az, cx * ay - cy * ax];
  const [wx, wy, wz] = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
  const six = ax * ux + ay * uy + az * uz; // times the volume
  return [ux, uy, uz, vx, vy, vz, wx, wy, wz].map((entry) => entry / six);
}
