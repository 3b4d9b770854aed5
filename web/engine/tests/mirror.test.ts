import assert from "node:assert/strict";
import { test } from "node:test";

import { mirroredMotions, readMirror, type Mirror } from "../mirror.ts";
import { applied, rotationOfEuler, type Vector } from "../motion.ts";

const near = (a: readonly number[], b: readonly number[]) =>
  a.forEach((x, i) => assert.ok(Math.abs(x - b[i]) < 1e-12, `${a} is not ${b}`));

const oblique: Mirror = { normal: [0.6, 0, 0.8], counterparts: [0, 2, 1] };
const motions = [
  { rotation: rotationOfEuler([0.1, 0, 0.2]), translation: [0.1, 0.2, 0.3] as Vector },
  { rotation: rotationOfEuler([0.5, -0.3, 1.2]), translation: [1, 2, 3] as Vector },
  { rotation: rotationOfEuler([0, 0, 0]), translation: [0, 0, 0] as Vector },
];

test("mirroring twice is the pose itself", () => {
  const back = mirroredMotions(mirroredMotions(motions, oblique), oblique);
  back.forEach(({ rotation, translation }, handle) => {
    near(rotation, motions[handle].rotation);
    near(translation, motions[handle].translation);
  });
});

test("counterparts swap, and a point moves to the mirror image of where it would", () => {
  const mirrored = mirroredMotions(motions, oblique);
  near(mirrored[1].translation, [0, 0, 0]);
  const image = ([x, y, z]: Vector): Vector => {
    const along = 2 * (0.6 * x + 0.8 * z);
    return [x - along * 0.6, y, z - along * 0.8];
  };
  const place: Vector = [0.3, -0.7, 0.2];
  near(applied(mirrored[2].rotation, image(place)), image(applied(motions[1].rotation, place)));
  near(mirrored[2].translation, image([1, 2, 3]));
});

test("an Euler angle about the normal stays, and those in the plane are reversed", () => {
  const plane: Mirror = { normal: [0, 1, 0], counterparts: [0] };
  for (const [euler, mirrored] of [
    [
      [0.3, 0, 0],
      [-0.3, 0, 0],
    ],
    [
      [0, 0.3, 0],
      [0, 0.3, 0],
    ],
    [
      [0, 0, 0.3],
      [0, 0, -0.3],
    ],
  ] as [Vector, Vector][]) {
    const [{ rotation }] = mirroredMotions(
      [{ rotation: rotationOfEuler(euler), translation: [0, 0, 0] }],
      plane,
    );
    near(rotation, rotationOfEuler(mirrored));
  }
});

test("what is damaged or missing is refused with a reason", () => {
  const whole = { normal: [1, 0, 0], counterparts: [0, 2, 1] };
  assert.deepEqual(readMirror(whole, 3), whole);
  assert.deepEqual(readMirror({ refused: "It is not." }, 3), { refused: "It is not." });
  for (const damaged of [
    undefined,
    null,
    "x",
    { ...whole, normal: [1, 1, 0] },
    { ...whole, normal: [1, 0] },
    { ...whole, counterparts: [1, 2, 0] },
    { ...whole, counterparts: [0, 1] },
    { ...whole, counterparts: [0, 1, 7] },
  ])
    assert.match((readMirror(damaged, 3) as { refused: string }).refused, /Export the page again/);
});
