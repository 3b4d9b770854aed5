/** Surfaces as triangles, 3 indices each; shapes are x0 y0 z0 x1 .... */

type Rows = ArrayLike<number>;

/** Normals as long as twice the areas. */
export function triangleNormals(shape: Rows, triangles: Int32Array | Uint32Array): Float64Array {
  const normals = new Float64Array(triangles.length);
  for (let i = 0; i < triangles.length; i += 3) {
    const edge = (corner: number, axis: number) =>
      shape[3 * triangles[i + corner] + axis] - shape[3 * triangles[i] + axis];
    for (let r = 0; r < 3; r++) {
      const [s, t] = [(r + 1) % 3, (r + 2) % 3];
      normals[i + r] = edge(1, s) * edge(2, t) - edge(1, t) * edge(2, s);
    }
  }
  return normals;
}

export function triangleAreas(shape: Rows, triangles: Int32Array): Float64Array {
  const normals = triangleNormals(shape, triangles);
  return Float64Array.from(
    { length: triangles.length / 3 },
    (_, t) => Math.hypot(normals[3 * t], normals[3 * t + 1], normals[3 * t + 2]) / 2,
  );
}

/** Hinges v0 v1 v2 v3 at the edges v0 v1 of the triangles v0 v1 v2 and v1 v0 v3, v0 < v1, in the order of the former; and
 * these triangles, two per hinge. As in snapspace/mesh/hinges.py. */
export function hingesOf(triangles: Int32Array): { hinges: Int32Array; sides: Int32Array } {
  const cornerAfter = (corner: number, steps: number) => corner - (corner % 3) + ((corner + steps) % 3);
  const key = (from: number, to: number) => from * 2 ** 26 + to; // below 2^53
  const corners = new Map<number, number>();
  triangles.forEach((vertex, corner) => corners.set(key(vertex, triangles[cornerAfter(corner, 1)]), corner));
  const [hinges, sides]: number[][] = [[], []];
  triangles.forEach((first, corner) => {
    const second = triangles[cornerAfter(corner, 1)];
    const against = corners.get(key(second, first));
    if (against === undefined || first > second) return;
    hinges.push(first, second, triangles[cornerAfter(corner, 2)], triangles[cornerAfter(against, 2)]);
    sides.push(Math.floor(corner / 3), Math.floor(against / 3));
  });
  return { hinges: Int32Array.from(hinges), sides: Int32Array.from(sides) };
}
