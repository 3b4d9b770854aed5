import assert from "node:assert/strict";
import { test } from "node:test";

import {
  allWeights,
  firstChoice,
  MOST_CHOSEN,
  reweighted,
  withoutNegatives,
  withoutPose,
  withPose,
  type PoseChoice,
} from "../pose_choice.ts";

const COUNT = 14;
const shape = (choice: PoseChoice) => allWeights(choice, COUNT);
const close = (a: readonly number[], b: readonly number[]) =>
  a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < 1e-12, `${a}, not ${b}`));

test("few poses all take part, but only some of many", () => {
  assert.deepEqual(firstChoice(MOST_CHOSEN).poses, [0, 1, 2, 3, 4, 5, 6, 7]);
  const { poses } = firstChoice(MOST_CHOSEN + 1);
  assert.ok(poses.length >= 2 && poses.length <= 3);
});

test("a pose that is added leaves the shape as it was", () => {
  const before: PoseChoice = { poses: [4, 2], weights: [0.3, 0.7] };
  const after = withPose(before, 11);
  assert.deepEqual(shape(after), shape(before));
  assert.deepEqual(after.poses, [4, 2, 11], "the order is that of choosing: a walk follows it");
});

test("a pose with weight zero that is taken away leaves the shape as it was", () => {
  const before: PoseChoice = { poses: [4, 2, 11], weights: [0.3, 0.7, 0] };
  close(shape(withoutPose(before, 11)), shape(before));
});

test("others take the weight of one that is taken away in their proportions", () => {
  const { poses, weights } = withoutPose({ poses: [4, 2, 11], weights: [0.1, 0.3, 0.6] }, 11);
  assert.deepEqual(poses, [4, 2]);
  close(weights, [0.25, 0.75]);
});

test("weights sum to one, and poses that were not chosen keep zero, whatever is done", () => {
  let choice = firstChoice(COUNT);
  let seed = 1;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  for (let act = 0; act < 500; act++) {
    const pose = Math.floor(COUNT * random());
    if (random() < 0.3) choice = withPose(choice, pose);
    else if (random() < 0.4) choice = withoutPose(choice, pose);
    // ends of a slider as well: 0 and 1 are where shares of the rest have nothing to share
    else choice = reweighted(choice, act % choice.poses.length, Math.round(4 * random()) / 4);
    const all = shape(choice);
    assert.ok(Math.abs(all.reduce((sum, w) => sum + w, 0) - 1) < 1e-9);
    assert.ok(all.every((w, k) => w >= 0 && (w === 0 || choice.poses.includes(k))));
    assert.ok(choice.poses.length >= 1 && choice.poses.length <= MOST_CHOSEN);
  }
});

test("the last pose stays, and one pose too many stays out", () => {
  const last: PoseChoice = { poses: [3], weights: [1] };
  assert.equal(withoutPose(last, 3), last);
  assert.deepEqual(reweighted(last, 0, 0).weights, [1]);
  const full = firstChoice(MOST_CHOSEN);
  assert.equal(withPose(full, 9), full);
});

test("beyond a pose the others go below zero in their proportions, and come back", () => {
  const start: PoseChoice = { poses: [4, 2, 11], weights: [0.5, 0.3, 0.2] };
  const beyond = reweighted(start, 0, 1.5);
  close(beyond.weights, [1.5, -0.3, -0.2]);
  close(reweighted(beyond, 0, 0.5).weights, start.weights);
  close(reweighted(start, 0, -0.5).weights, [-0.5, 0.9, 0.6]);
  close(withoutNegatives(reweighted(start, 0, -0.5)).weights, [0, 0.6, 0.4]);
  close(withoutNegatives(beyond).weights, [1, 0, 0]);
});
