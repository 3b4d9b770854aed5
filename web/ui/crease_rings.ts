import type { Appearance } from "../engine/index.ts";
import { rings } from "./rings.ts";

/** `rings` of the points that are drawn, on their side of sharp edges: the pairs are vertices of the surface. */
export function creaseRings({ points, triangles, creases }: Appearance): {
  ranges: Int32Array<ArrayBuffer>;
  pairs: Int32Array<ArrayBuffer>;
} {
  const vertices: number[] = []; // vertices of each side
  const numbers = new Map<string, number>();
  const sides = Int32Array.from(points, (vertex, point) => {
    const key = `${vertex} ${creases?.[point] ?? 0}`;
    let side = numbers.get(key);
    if (side === undefined) numbers.set(key, (side = vertices.push(vertex) - 1));
    return side;
  });
  const around = rings(
    triangles.map((point) => sides[point]),
    vertices.length,
  );
  const ranges = new Int32Array(2 * points.length);
  sides.forEach((side, point) => ranges.set(around.ranges.subarray(2 * side, 2 * side + 2), 2 * point));
  return { ranges, pairs: Int32Array.from(around.pairs, (side) => vertices[side]) };
}
