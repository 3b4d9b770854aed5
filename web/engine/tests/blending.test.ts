import assert from "node:assert/strict";
import { test } from "node:test";

import { BlendingSession } from "../blending_session.ts";
import { Core } from "../core.ts";
import type { BlendingModel } from "../model.ts";
import { readModel } from "../read_model.ts";
import { reconstruct } from "../shape_space.ts";
import { bytes, core, distance, expected, isCertificate } from "./expected.ts";

interface Frame {
  weights: number[];
  value: number;
  surface: number[];
  linear: number[];
  certificate: [number, number] | null;
  outside: string[];
}

for (const [name, ending] of [
  ["blending", "snapspace"],
  ["blending", "packed"],
  ["blending-cubature", "snapspace"],
  ["blending-cubature", "packed"],
])
  test(`blends are those of Session: ${name}.${ending}`, async () => {
    const { frames, diagonal } = expected<{ frames: Frame[]; diagonal: number }>(`${name}.json`);
    const model = readModel(bytes(`${name}.${ending}`), "poses") as BlendingModel;
    assert.equal(model.blends.kind, name === "blending" ? "quartics" : "cubature");
    const session = await BlendingSession.create(core, model);
    const { valueScale } = await Core.create(core, model);
    const shape = new Float32Array(3 * model.space.vertices);
    for (const frame of frames) {
      const report = session.blend(frame.weights);
      assert.equal(report.status, "converged");
      assert.ok(Math.abs(report.value - frame.value) < 1e-4 * Math.abs(frame.value) + 1e-6 * valueScale);
      reconstruct(model.space, session.q, shape);
      assert.ok(distance(shape, frame.surface) < 1e-4 * diagonal);
      reconstruct(model.poseSpace, frame.weights, shape);
      assert.ok(distance(shape, frame.linear) < 3e-5 * diagonal, "the linear blend of registered poses");
      isCertificate(session.certificate(), frame.certificate, 1e-2);
      assert.deepEqual(session.outside, frame.outside);
    }
    assert.throws(() => session.blend(model.poses.map(() => 1)), /a sum of one/);
    session.reset();
    assert.ok(session.q.every((x) => x === 0));
  });
