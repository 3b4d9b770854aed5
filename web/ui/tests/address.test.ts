import assert from "node:assert/strict";
import { test } from "node:test";

import { rotationOfEuler, type Vector } from "../../engine/motion.ts";
import { blendHash, blendOf, motionsOf, poseHash } from "../address.ts";

const REST = { rotation: rotationOfEuler([0, 0, 0]), translation: [0, 0, 0] as Vector };

test("a pose comes back out of its hash, whatever its handles are called", () => {
  const moved = { rotation: rotationOfEuler([0.1, -0.7, 3]), translation: [1e-7, -20.125, 3] as Vector };
  const motions = new Map([
    ["a:b;c,d=#%é '()", moved],
    ["foot", REST],
  ]);
  const hash = new URL(poseHash(motions), "http://localhost/?a").hash;
  const found = motionsOf(hash);
  assert.deepEqual([...found.keys()], [...motions.keys()]);
  const { rotation, translation } = found.get("a:b;c,d=#%é '()")!;
  rotation.forEach((entry, i) => assert.ok(Math.abs(entry - moved.rotation[i]) < 1e-5));
  assert.deepEqual(translation, moved.translation);
});

test("at rest there is no hash", () => assert.equal(poseHash(new Map([["foot", REST]])), ""));

test("a blend comes back", () => {
  const hash = new URL(blendHash({ names: ["run; sit", "b"], weights: [0.25, 0.75] }), "http://localhost/")
    .hash;
  assert.deepEqual(blendOf(hash), { names: ["run; sit", "b"], weights: [0.25, 0.75] });
});

test("damaged hashes hold nothing", () => {
  for (const hash of [
    "",
    "#",
    "#pose=",
    "#pose=a:1,2,3",
    "#pose=a:1,2,3,4,5,x",
    "#pose=%E0%A4:1,2,3,4,5,6",
    "#choose",
  ])
    assert.equal(motionsOf(hash).size, 0, hash);
  for (const hash of ["#blend=", "#blend=a:1,2", "#blend=a", "#pose=a:1"])
    assert.deepEqual(blendOf(hash).names, [], hash);
});
