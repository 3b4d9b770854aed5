import assert from "node:assert/strict";
import { test } from "node:test";

import { closestMap } from "../registration.ts";
import { applied, plus, rotationOfEuler, type Vector } from "../motion.ts";

const POINTS: Vector[] = [
  [0, 0, 0],
  [2, 0, 0],
  [0, 1, 0],
  [0.3, 0.2, 1],
];

function close(a: readonly number[], b: readonly number[], by = 1e-12): void {
  a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < by, `${a} is not ${b}`));
}

test("a rigid motion of points is found, also where they are flat", () => {
  const rotation = rotationOfEuler([0.4, -1.2, 2.5]);
  const moved = POINTS.map((point) => plus(applied(rotation, point), [3, -1, 0.5]));
  for (const count of [3, 4]) {
    const found = closestMap(POINTS.slice(0, count), moved.slice(0, count));
    close(found.rotation, rotation);
    close(found.shift, [3, -1, 0.5]);
  }
});

test("points that are stretched evenly keep their rotation", () => {
  const rotation = rotationOfEuler([0, 0, 0.7]);
  const found = closestMap(
    POINTS,
    POINTS.map((point) => applied(rotation, [1.5 * point[0], 1.5 * point[1], 1.5 * point[2]])),
  );
  close(found.rotation, rotation);
});

test("a single point is only translated, and no points give the identity", () => {
  const found = closestMap([[1, 2, 3]], [[2, 2, 5]]);
  close(found.rotation, [1, 0, 0, 0, 1, 0, 0, 0, 1]);
  close(found.shift, [1, 0, 2]);
  close(closestMap([], []).shift, [0, 0, 0]);
});
