import assert from "node:assert/strict";
import { test } from "node:test";

import { EvenWalk, LEAST_STEP, type ShapePath } from "../even_walk.ts";

const MOST_SOLVES = 18;

/** Walks to the end: shares, numbers of solves and motions of the steps, and the jumps. */
function walked(curve: (share: number, from: number) => number, even: number, length: number) {
  let solves = 0;
  const path: ShapePath<number> = {
    solve: (share, from) => (solves++, curve(share, from)),
    motion: (from, to) => Math.abs(to - from),
  };
  const walk = new EvenWalk(path, curve(0, 0), length);
  const [shares, motions, costs, jumps] = [[0], [] as number[], [] as number[], [] as number[]];
  while (walk.share < 1) {
    const before = walk.shape;
    solves = 0;
    if (walk.step(even) > 0) jumps.push(walk.share);
    costs.push(solves);
    shares.push(walk.share);
    motions.push(Math.abs(walk.shape - before));
    assert.ok(walk.share > shares.at(-2)!, "it never stands still");
    assert.ok(solves <= MOST_SOLVES);
    assert.ok(shares.length < 10_000);
  }
  return { shares, motions, costs, jumps, shape: walk.shape };
}

const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;

test("where the shape moves fast the weights move slowly", () => {
  // the speed by share goes from nearly 0 to 30 and back
  const curve = (share: number) => Math.tanh(30 * (share - 0.5));
  const { shares, motions, costs, jumps, shape } = walked(curve, 0.02, 1);
  assert.equal(shape, curve(1), "it ends at the end");
  assert.deepEqual(jumps, []);
  assert.ok(Math.max(...motions) <= 1.25 * 0.02);
  // all but those that rest where the shape does, and the last one
  const moving = motions.filter((_, i) => Math.abs(shares[i + 1] - 0.5) < 0.06);
  assert.ok(Math.min(...moving) >= 0.8 * 0.02, `${Math.min(...moving)}`);
  assert.ok(moving.length > 60);
  assert.ok(mean(costs) < 2, `${mean(costs)} solves of a step`);
});

test("a steep part is walked in small steps, and is no jump", () => {
  // between two of 100 equal steps of the weights it moves by 1.9 of 2
  const curve = (share: number) => Math.tanh(400 * (share - 0.505));
  const { motions, jumps } = walked(curve, 0.05, 2);
  assert.deepEqual(jumps, []);
  assert.ok(Math.max(...motions) <= 1.25 * 0.05);
});

/** The minimum of x^4 / 4 - x^2 / 2 - f x that a descent from a shape comes to; with f beyond 0.385 there is one only. */
function bistable(share: number, from: number): number {
  const force = 1.2 * (share - 0.5);
  let x = share === 0 ? -1.2 : from;
  for (let i = 0; i < 4000; i++) x -= 0.05 * (x ** 3 - x - force);
  return x;
}

test("a jump that no step resolves is reported once, with its place", () => {
  const even = 0.02;
  const { jumps, motions, shares, costs } = walked(bistable, even, 2);
  const fold = 0.5 + 2 / (3 * Math.sqrt(3)) / 1.2;
  assert.equal(jumps.length, 1);
  assert.ok(Math.abs(jumps[0] - fold) < 20 * LEAST_STEP, `${jumps[0]}, not ${fold}`); // descents are slow at a fold
  const others = motions.filter((_, i) => shares[i + 1] !== jumps[0]);
  assert.ok(Math.max(...others) <= 4 * even + 1e-12);
  assert.ok(others.filter((motion) => motion > 1.25 * even).length <= 1, "only the last one before the fold");
  assert.ok(shares.length < 120, "it does not creep towards the jump");
  assert.ok(mean(costs) < 3);
});

test("a shape that rests is passed in a few steps", () => {
  const { shares } = walked(() => 1, 0.01, 0);
  assert.equal(shares.length, 5);
  // and a length that was guessed too short does no harm
  const { motions } = walked((share) => 10 * share, 0.01, 0.01);
  assert.ok(Math.max(...motions) <= 0.0125);
});
