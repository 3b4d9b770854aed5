import assert from "node:assert/strict";
import { test } from "node:test";

import { copyRows, sharpEdges } from "../sharp_edges.ts";

/** A roof over the square from -1 to 1, whose ridge from (0, -1) to (0, 1) is `height` high. */
function roof(height: number): [Float32Array, Uint32Array<ArrayBuffer>] {
  const rows = [-1, 0, 1].map((y) => [-1, y, 0, 0, y, height, 1, y, 0]);
  const quads = [0, 1, 3, 4].map((a) => [a, a + 1, a + 4, a, a + 4, a + 3]);
  return [Float32Array.from(rows.flat()), Uint32Array.from(quads.flat())];
}

test("a gentle ridge is smooth", () => assert.equal(sharpEdges(...roof(0.4)), null));

test("a ridge has a point on each side, which knows the faces of its side", () => {
  const [shape, faces] = roof(1);
  const sharp = sharpEdges(shape, faces)!;
  assert.deepEqual([...sharp.points], [0, 1, 2, 3, 4, 5, 6, 7, 8, 1, 4, 7]);
  assert.deepEqual(
    sharp.triangles.map((point) => sharp.points[point]),
    faces,
  );
  const pointsOf = (side: number) => {
    const corners = [...sharp.triangles].filter((_, corner) => (corner % 12 < 6 ? 0 : 1) === side);
    return new Set(corners.filter((point) => [1, 4, 7].includes(sharp.points[point])));
  };
  assert.deepEqual([...pointsOf(0)].sort(), [1, 4, 7]);
  assert.deepEqual([...pointsOf(1)].sort(), [10, 11, 9]);
  const ringOf = (point: number) => {
    const [start, count] = sharp.ranges.subarray(2 * point, 2 * point + 2);
    return [...sharp.pairs.subarray(2 * start, 2 * (start + count))];
  };
  for (const [point, side] of [
    [4, [0, 1, 3, 4, 6, 7]],
    [10, [1, 2, 4, 5, 7, 8]],
  ] as const) {
    const ring = ringOf(point);
    assert.equal(ring.length, 6);
    assert.ok(ring.every((vertex) => side.includes(vertex as never)));
  }
  assert.deepEqual(ringOf(0), [], "its vertex has a normal");
});

test("points have the rows of their vertices", () => {
  const rows = Float32Array.of(1, 2, 3, 4, 5, 6, 0, 0, 0);
  copyRows(rows, Int32Array.of(0, 1, 1), 2);
  assert.deepEqual([...rows], [1, 2, 3, 4, 5, 6, 4, 5, 6]);
});

test("an edge that ends within a smooth surface splits nothing there", () => {
  const [shape, faces] = roof(1);
  shape[3 * 7 + 2] = 0; // the ridge goes down to the ground at one end
  const sharp = sharpEdges(shape, faces)!;
  assert.ok(sharp.points.subarray(9).includes(1) && !sharp.points.subarray(9).includes(7));
});

test("a triangle without area joins no sides", () => {
  const [shape, faces] = roof(1);
  const flat = sharpEdges(shape, Uint32Array.of(...faces, 1, 4, 7))!;
  assert.deepEqual([...flat.points.subarray(9, 12)], [1, 4, 7]);
});
