import assert from "node:assert/strict";
import { test } from "node:test";

import type { Vector } from "../motion.ts";
import { distanceAlong } from "../ray_triangle.ts";
import {
  inBall,
  inLasso,
  inRectangle,
  nearestTo,
  placesOf,
  seenFrom,
  union,
  without,
  type ScreenPoint,
} from "../selecting.ts";
import { TriangleTree } from "../triangle_tree.ts";

/** The same numbers in every run (Park and Miller 1988). */
function random(seed: number): () => number {
  let state = seed;
  return () => (state = (16807 * state) % 2147483647) / 2147483647;
}

/** A closed surface like a potato, outward, as a grid of latitudes and longitudes with its two poles. */
function potato(rows: number, columns: number): { shape: Float32Array; faces: Uint32Array } {
  const next = random(7);
  const points: number[] = [];
  for (let i = 1; i < rows; i++)
    for (let j = 0; j < columns; j++) {
      const [t, p] = [(Math.PI * i) / rows, (2 * Math.PI * j) / columns];
      const r = 1 + 0.2 * next();
      points.push(r * Math.sin(t) * Math.cos(p), r * Math.sin(t) * Math.sin(p), r * Math.cos(t));
    }
  const [north, south] = [points.length / 3, points.length / 3 + 1];
  points.push(0, 0, 1, 0, 0, -1);
  const at = (i: number, j: number) => i * columns + (j % columns);
  const faces: number[] = [];
  for (let j = 0; j < columns; j++) {
    faces.push(north, at(0, j), at(0, j + 1), south, at(rows - 2, j + 1), at(rows - 2, j));
    for (let i = 0; i + 2 < rows; i++)
      faces.push(at(i, j), at(i + 1, j), at(i, j + 1), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
  }
  return { shape: Float32Array.from(points), faces: Uint32Array.from(faces) };
}

const { shape, faces } = potato(20, 31);

test("the tree finds what a search of all triangles finds", () => {
  const tree = new TriangleTree(shape, faces);
  const next = random(3);
  const vector = (size: number): Vector => [
    size * (next() - 0.5),
    size * (next() - 0.5),
    size * (next() - 0.5),
  ];
  let hits = 0;
  for (let i = 0; i < 2000; i++) {
    // also along the axes, where a ray lies in faces of boxes
    const [origin, direction] =
      i % 10 === 0
        ? [[0, 0, 3] as const, [0, 0, -1] as const]
        : [vector(4), i % 10 === 1 ? ([1, 0, 0] as const) : vector(2)];
    let nearest = Infinity;
    for (let f = 0; f < faces.length; f += 3)
      nearest = Math.min(nearest, distanceAlong(shape, faces, f, ...origin, ...direction));
    const found = tree.hit(origin, direction);
    assert.equal(found?.along ?? Infinity, nearest);
    assert.equal(tree.isBlocked(origin, direction, 0, 1), nearest < 1);
    if (found) hits++;
  }
  assert.ok(hits > 300);
});

test("a tree may have all triangles at one place, or none at all", () => {
  const heap = new Uint32Array(60).map((_, i) => i % 3);
  const corner = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  assert.equal(new TriangleTree(corner, heap).hit([0.2, 0.2, 1], [0, 0, -1])?.along, 1);
  assert.equal(new TriangleTree(corner, new Uint32Array(0)).hit([0.2, 0.2, 1], [0, 0, -1]), null);
});

test("a ball takes what is as near as its radius", () => {
  const line = Float32Array.from([0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0]);
  assert.deepEqual([...inBall(line, [1, 0, 0], 1)], [0, 1, 2]);
  assert.deepEqual([...inBall(line, [1, 5, 0], 1)], []);
  assert.deepEqual([...nearestTo(line, [0.9, 5, 0])], [1]);
});

test("places are those of a camera, and nothing behind it is in a box", () => {
  // looks down -z from the origin with 90 degrees: x / -z from -1 to 1 is the width
  const matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0];
  const points = Float32Array.from([0, 0, -2, 2, 0, -2, 0, 1, -2, 0, 0, 2]);
  const places = placesOf(points, matrix, 400, 200);
  assert.deepEqual([...places.slice(0, 6)], [200, 100, 400, 100, 200, 50]);
  assert.ok(Number.isNaN(places[6]));
  assert.deepEqual([...inRectangle(places, [500, 300], [-10, -10])], [0, 1, 2]);
  assert.deepEqual([...inRectangle(places, [150, 40], [250, 60])], [2]);
});

test("a lasso is its polygon, whichever way round and however often", () => {
  const grid = Float32Array.from({ length: 2 * 21 * 21 }, (_, i) =>
    i % 2 ? Math.floor(i / 42) : (i >> 1) % 21,
  );
  const isIn = (line: ScreenPoint[]) => new Set(inLasso(grid, line));
  const square: ScreenPoint[] = [
    [4.5, 3.5],
    [10.5, 3.5],
    [10.5, 8.5],
    [4.5, 8.5],
  ];
  const box = new Set(inRectangle(grid, [4.5, 3.5], [10.5, 8.5]));
  assert.equal(box.size, 30);
  assert.deepEqual(isIn(square), box);
  assert.deepEqual(isIn([...square].reverse()), box);
  assert.deepEqual(isIn([...square, ...square]), box, "a hand continues after it has closed the line");
  assert.equal(isIn(square.slice(0, 2)).size, 0);
  const circle = Array.from({ length: 200 }, (_, i): ScreenPoint => {
    const angle = (2 * Math.PI * i) / 200;
    return [10 + 6.3 * Math.cos(angle), 10 + 6.3 * Math.sin(angle)];
  });
  const round = isIn(circle);
  for (let i = 0; i < 441; i++)
    assert.equal(round.has(i), Math.hypot((i % 21) - 10, Math.floor(i / 21) - 10) < 6.3);
});

test("what is seen from an eye is the near side", () => {
  const tree = new TriangleTree(shape, faces);
  const all = Int32Array.from({ length: shape.length / 3 }, (_, i) => i);
  const seen = new Set(seenFrom([0, 0, 6], tree, shape, faces, all));
  const north = shape.length / 3 - 2;
  assert.ok(seen.has(north) && !seen.has(north + 1));
  for (const vertex of all) {
    const [x, y, z] = shape.subarray(3 * vertex, 3 * vertex + 3);
    if (z < -0.2) assert.ok(!seen.has(vertex), "the far side is hidden");
    if (z > 0.5 * Math.hypot(x, y) + 0.4) assert.ok(seen.has(vertex), "nothing is before the near side");
  }
  // a vertex of no triangle is inside
  const withInside = Float32Array.from([...shape, 0, 0, 0]);
  const inside = Int32Array.of(shape.length / 3);
  assert.equal(seenFrom([0, 0, 6], tree, withInside, faces, inside).length, 0);
});

test("unions and differences of sets of vertices are ascending", () => {
  const next = random(11);
  for (let i = 0; i < 50; i++) {
    const set = () =>
      Int32Array.from(new Set(Array.from({ length: 12 }, () => Math.floor(20 * next())))).sort();
    const [a, b] = [set(), set()];
    assert.deepEqual(union(a, b), Int32Array.from(new Set([...a, ...b])).sort());
    assert.deepEqual(
      [...without(a, b)],
      [...a].filter((x) => !b.includes(x)),
    );
  }
});
