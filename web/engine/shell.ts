import type { Material } from "./model.ts";

/** A shell at rest, as ShellMesh and ShellMaterial of the Python package have it. */
export interface Shell {
  /** Triangles with their last corner twice, and after them hinges: four corners each. */
  readonly elements: Int32Array;
  /** Areas of the triangles, times thickness. */
  readonly volumes: Float64Array;
  /** A third of the volume of the triangles at each vertex. */
  readonly masses: Float64Array;
  /** Of the elements. */
  readonly material: Material;
  /** Unit of energy: that of bending by a curvature of sqrt(2) over the diagonal, times its square. */
  readonly bendingScale: number;
}

/** The shell of triangles. `thickness` and moduli have one number, or one per triangle. */
export function shellOf(
  rest: Float64Array,
  triangles: Int32Array,
  thickness: Float64Array,
  material: Material,
): Shell {
  const [count, vertices] = [triangles.length / 3, rest.length / 3];
  const { hinges, sides } = hingesOf(triangles);
  const [areas, volumes] = [triangleAreas(rest, triangles), new Float64Array(count)];
  const [masses, rigidities] = [new Float64Array(vertices), new Float64Array(count)];
  const elements = new Int32Array(4 * count + hinges.length);
  const moduli = new Float64Array((3 * elements.length) / 4);
  let bendingScale = 0;
  for (let t = 0; t < count; t++) {
    const corners = triangles.subarray(3 * t, 3 * t + 3);
    const thick = thickness[thickness.length === 1 ? 0 : t];
    const [lam, mu] = lameOf(material, t);
    const plane = (2 * lam * mu) / (lam + 2 * mu); // plane stress
    volumes[t] = areas[t] * thick;
    rigidities[t] = ((2 * mu + plane) * thick ** 3) / 12;
    bendingScale += rigidities[t] * areas[t];
    for (const vertex of corners) masses[vertex] += volumes[t] / 3;
    elements.set([...corners, corners[2]], 4 * t);
    moduli.set([mu * thick, plane * thick, 0], 3 * t);
  }
  elements.set(hinges, 4 * count);
  for (let hinge = 0; hinge < hinges.length / 4; hinge++) {
    const [a, b] = sides.subarray(2 * hinge, 2 * hinge + 2);
    const bending = (areas[a] * rigidities[a] + areas[b] * rigidities[b]) / (areas[a] + areas[b]);
    moduli[3 * (count + hinge) + 2] = bending;
  }
  const points = Float64Array.from(
    { length: 3 * elements.length },
    (_, i) => rest[3 * elements[Math.floor(i / 3)] + (i % 3)],
  );
  const kind = `shell-${material.kind}`;
  const ofElements = { kind, rows: elements.length / 4, moduli, shellPoints: points };
  return { elements, volumes, masses, material: ofElements, bendingScale };
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

function triangleAreas(rest: Float64Array, triangles: Int32Array): Float64Array {
  return Float64Array.from({ length: triangles.length / 3 }, (_, t) => {
    const at = (corner: number, axis: number) => rest[3 * triangles[3 * t + corner] + axis];
    const edge = (corner: number) => [0, 1, 2].map((axis) => at(corner, axis) - at(0, axis));
    const [[ax, ay, az], [bx, by, bz]] = [edge(1), edge(2)];
    return Math.hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx) / 2;
  });
}

/** The Lame parameters of a triangle. Densities with a membrane have these two moduli, in this order. */
function lameOf({ moduli, rows }: Material, triangle: number): [number, number] {
  if (!(moduli instanceof Float64Array)) {
    const { lam, mu } = moduli as { readonly lam: number; readonly mu: number };
    return [Number(lam), Number(mu)];
  }
  const row = rows === 1 ? 0 : triangle;
  return [moduli[2 * row], moduli[2 * row + 1]];
}
