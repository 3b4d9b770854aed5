import assert from "node:assert/strict";
import { test } from "node:test";

import { carriedOver, ShapeTransition } from "../shape_transition.ts";

test("a transition begins where the shape was and ends where it goes, in small steps", () => {
  const [from, to] = [
    [1, 0, -2],
    [3, 4, 0],
  ];
  const transition = new ShapeTransition(from, to);
  assert.deepEqual([...transition.at(to)], from);
  let [last, pictures] = [transition.at(to), 0];
  while (!transition.isOver) {
    transition.advance(0.016);
    const next = transition.at(to);
    assert.ok(next[0] > last[0] && next[0] - last[0] < 0.09 * (to[0] - from[0]));
    [last, pictures] = [next, pictures + 1];
  }
  assert.equal(pictures, 19, "three tenths of a second");
  assert.deepEqual([...last], to);
});

test("a late picture is no jump", () => {
  const transition = new ShapeTransition([0], [1]);
  transition.advance(2);
  assert.ok(!transition.isOver && transition.at([1])[0] < 0.1);
});

test("a shape that moves meanwhile is followed", () => {
  const transition = new ShapeTransition([1], [2]);
  transition.advance(0.05);
  assert.equal(transition.at([2])[0] + 5, transition.at([7])[0]);
  for (let i = 0; i < 6; i++) transition.advance(0.05);
  assert.deepEqual([...transition.at([7, 3])], [7, 3], "also one of more dimensions");
});

test("a shape is carried over by rows", () => {
  assert.deepEqual([...carriedOver(Float32Array.of(1, 2, 3, 4, 5, 6), Float64Array.of(1, 10))], [21, 43, 65]);
});
