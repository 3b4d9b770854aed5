import assert from "node:assert/strict";
import { test } from "node:test";

import { quantised, reconstruct, type ShapeSpace } from "../../engine/shape_space.ts";
import { MotionProbe } from "../motion_probe.ts";

/** The largest motion of all vertices. */
function largest(space: ShapeSpace, from: number[], to: number[]): number {
  const [a, b] = [new Float32Array(space.base.length), new Float32Array(space.base.length)];
  reconstruct(space, from, a);
  reconstruct(space, to, b);
  let most = 0;
  for (let i = 0; i < a.length; i += 3)
    most = Math.max(most, Math.hypot(b[i] - a[i], b[i + 1] - a[i + 1], b[i + 2] - a[i + 2]));
  return most;
}

function spaceOf(vertices: number, ...modes: ((vertex: number, axis: number) => number)[]): ShapeSpace {
  const rows = modes.flatMap((mode) =>
    Array.from({ length: 3 * vertices }, (_, i) => mode(Math.floor(i / 3), i % 3)),
  );
  return quantised(new Float64Array(3 * vertices), Float64Array.from(rows));
}

test("on a small surface, all vertices count", () => {
  const space = spaceOf(
    90,
    (vertex, axis) => Math.sin(vertex + axis),
    (vertex, axis) => Math.cos(2 * vertex - axis),
  );
  const [from, to] = [
    [0.2, -0.4],
    [1.1, 0.7],
  ];
  const wanted = largest(space, from, to);
  assert.ok(Math.abs(new MotionProbe(space).between(from, to) - wanted) < 1e-4 * wanted);
});

test("on a large surface, a tip that moves alone is not missed, nor are smooth motions", () => {
  const count = 20_011;
  const tip = 12_345;
  const space = spaceOf(
    count,
    (vertex, axis) => (vertex === tip && axis === 1 ? 2 : 0),
    (vertex, axis) => (axis === 0 ? Math.sin((3 * vertex) / count) : 0),
  );
  const probe = new MotionProbe(space);
  assert.ok(Math.abs(probe.between([0, 0], [1.5, 0]) - 3) < 1e-3);
  const smooth = largest(space, [0, 0], [0, 1]);
  assert.ok(probe.between([0, 0], [0, 1]) > 0.999 * smooth);
});

test("fewer coordinates are the leading ones", () => {
  const space = spaceOf(
    10,
    () => 1,
    () => 5,
  );
  assert.ok(Math.abs(new MotionProbe(space).between([0], [2]) - 2 * Math.sqrt(3)) < 1e-3);
});
