import assert from "node:assert/strict";
import { test } from "node:test";

import { BlendingSession } from "../blending_session.ts";
import type { BlendingModel, PosingModel } from "../model.ts";
import { rotationOfEuler, type Vector } from "../motion.ts";
import { PosingSession } from "../posing_session.ts";
import { readModel } from "../read_model.ts";
import { bytes, core, distance, expected } from "./expected.ts";

interface Steps {
  gravity: Vector;
  motions: [number, Vector, Vector][][];
  q: number[][];
}

const REST = { rotation: rotationOfEuler([0, 0, 0]), translation: [0, 0, 0] as Vector };

for (const [file, { gravity, motions, q }] of Object.entries(expected<Record<string, Steps>>("steps.json")))
  test(`steps in time are those of Session: ${file}`, async () => {
    const session = await PosingSession.create(core, readModel(bytes(file), "bar") as PosingModel);
    session.time.dynamics = { frequency: 1.5, damping: 0.1, gravity };
    motions.forEach((given, k) => {
      const wanted = given.map(
        ([handle, euler, translation]) =>
          [handle, { rotation: rotationOfEuler(euler), translation }] as const,
      );
      assert.equal(session.step(1 / 60, new Map(wanted)).status, "converged");
      assert.ok(distance(session.q, q[k]) < 1e-3 * session.model.coordinateScale, `step ${k}`);
    });
  });

for (const name of ["blending-cubature", "blending-arap"])
  test(`blends swing as those of Session: ${name}`, async () => {
    const { weights, q } = expected<{ weights: number[][]; q: number[][] }>(`${name}-steps.json`);
    const model = readModel(bytes(`${name}.packed`), "") as BlendingModel;
    const session = await BlendingSession.create(core, model);
    weights.forEach((given, k) => {
      session.step(1 / 60, given);
      assert.ok(distance(session.q, q[k]) < 1e-3 * model.coordinateScale, `step ${k}`);
    });
    assert.throws(() => session.step(1 / 60, [1, 1, 1]), RangeError);
  });

test("a body comes to rest, and a static frame stops it", async () => {
  const session = await PosingSession.create(core, readModel(bytes("cubature.packed"), "") as PosingModel);
  session.move(1, [0, 0.4, 0.2], [0.1, 0.2, 0]);
  assert.equal(session.speed, 0);
  session.step(1 / 60, new Map([[1, REST]]));
  let fastest = session.speed;
  assert.ok(fastest > 0.1);
  for (let k = 0; k < 200; k++) {
    session.step(1 / 15);
    assert.ok(session.speed <= 2 * fastest);
    fastest = Math.max(fastest, session.speed);
  }
  assert.ok(
    session.speed < 1e-3 &&
      distance(session.q, new Float64Array(session.q.length)) < 1e-4 * session.model.coordinateScale,
  );
  session.step(1 / 60, new Map([[1, { ...REST, translation: [0.1, 0, 0] as Vector }]]));
  session.move(1, [0, 0, 0], [0, 0, 0]);
  assert.equal(session.speed, 0);
});
