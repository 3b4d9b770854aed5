import assert from "node:assert/strict";
import { test } from "node:test";

import type { Vector } from "../motion.ts";
import { distanceAlong } from "../ray_triangle.ts";
import { ShapePicker } from "../shape_picker.ts";
import { quantised, reconstruct } from "../shape_space.ts";

/** Numbers in [-1, 1), the same every time. */
function numbers(seed: number): () => number {
  let state = seed;
  return () => (state = (1664525 * state + 1013904223) % 2 ** 32) / 2 ** 31 - 1;
}

/** A bumpy ball of many triangles, with smooth modes and rough ones. */
function ball(rows: number, count: number) {
  const at = (i: number, j: number) => i * rows + (j % rows);
  const base: number[] = [];
  for (let i = 0; i < rows; i++)
    for (let j = 0; j < rows; j++) {
      const [across, down] = [(2 * Math.PI * j) / rows, (Math.PI * (i + 0.5)) / rows];
      base.push(Math.sin(down) * Math.cos(across), Math.sin(down) * Math.sin(across), Math.cos(down));
    }
  const faces: number[] = [];
  for (let i = 0; i + 1 < rows; i++)
    for (let j = 0; j < rows; j++)
      faces.push(at(i, j), at(i + 1, j), at(i, j + 1), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
  const random = numbers(3);
  const modes = Float64Array.from({ length: count * base.length }, (_, i) => {
    const mode = Math.floor(i / base.length);
    const x = base[i % base.length];
    return mode < count - 1 ? Math.sin((mode + 1) * x + mode) : random();
  });
  return { space: quantised(Float64Array.from(base), modes), faces: Uint32Array.from(faces) };
}

/** The first hit among all triangles of a shape. */
function first(shape: Float32Array, faces: Uint32Array, o: Vector, d: Vector): number {
  let least = Infinity;
  for (let f = 0; f < faces.length; f += 3)
    least = Math.min(least, distanceAlong(shape, faces, f, ...o, ...d));
  return least;
}

test("a ray hits what a search of all triangles finds, in every shape", () => {
  const { space, faces } = ball(40, 5);
  const picker = new ShapePicker(space, faces);
  const shape = new Float32Array(space.base.length);
  const goal = space.base.map((x, i) => 1.3 * x + 0.2 * Math.sin(i));
  const random = numbers(1);
  let hits = 0;
  for (let trial = 0; trial < 60; trial++) {
    const coefficients = Array.from({ length: 1 + (trial % 5) }, () => 0.4 * random());
    reconstruct(space, coefficients, shape);
    const share = trial % 3 === 0 ? 0 : Math.abs(random());
    if (trial === 1) picker.goal = goal;
    if (trial > 0) for (let i = 0; i < shape.length; i++) shape[i] += share * (goal[i] - shape[i]);
    picker.show(coefficients, trial > 0 ? share : 0);
    for (let ray = 0; ray < 5; ray++) {
      const origin: Vector = [3 * random(), 3 * random(), 3];
      const [x, y, z] = [random() - origin[0], random() - origin[1], random() - origin[2]];
      const length = Math.hypot(x, y, z);
      const direction: Vector = [x / length, y / length, z / length];
      const found = picker.pick(origin, direction);
      const expected = first(shape, faces, origin, direction);
      assert.equal(found === null, expected === Infinity);
      if (!found) continue;
      hits++;
      assert.ok(Math.abs(found.along - expected) < 1e-5, `${found.along} instead of ${expected}`);
      const away = (v: number) => Math.hypot(...found.point.map((x, axis) => shape[3 * v + axis] - x));
      assert.ok(away(found.corners[0]) <= away(found.corners[1]) + 1e-6);
      assert.ok(away(found.corners[1]) <= away(found.corners[2]) + 1e-6);
    }
  }
  assert.ok(hits > 100);
});
