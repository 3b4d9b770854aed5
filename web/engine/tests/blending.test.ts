import assert from "node:assert/strict";
import { test } from "node:test";

import { BlendingSession } from "../blending_session.ts";
import { certainRange } from "../certain_range.ts";
import { Core } from "../core.ts";
import type { BlendingModel } from "../model.ts";
import { readModel } from "../read_model.ts";
import { SampleValues } from "../sample_values.ts";
import { reconstruct } from "../shape_space.ts";
import { weightEnds } from "../weight_ends.ts";
import { bytes, core, distance, expected, isCertificate } from "./expected.ts";

interface Frame {
  weights: number[];
  value: number;
  surface: number[];
  linear: number[];
  certificate: [number, number] | null;
  outside: string[];
  certain: boolean | null;
}
type Ends = [number, number][];
interface Blends {
  frames: Frame[];
  diagonal: number;
  leading: number;
  ends: Ends | null;
}

for (const [name, ending, kind] of [
  ["blending", "snapspace", "quartics"],
  ["blending", "packed", "quartics"],
  ["blending-cubature", "snapspace", "cubature"],
  ["blending-cubature", "packed", "cubature"],
  ["blending-clustered", "snapspace", "cubature"],
  ["blending-clustered", "packed", "cubature"],
  ["blending-shell", "snapspace", "cubature"],
  ["blending-shell", "packed", "cubature"],
  ["blending-arap", "snapspace", "stars"],
  ["blending-arap", "packed", "stars"],
  ["blending-radius", "snapspace", "stars"],
  ["blending-radius", "packed", "stars"],
])
  test(`blends are those of Session: ${name}.${ending}`, async () => {
    const { frames, diagonal, leading, ends } = expected<Blends>(`${name}.json`);
    const model = readModel(bytes(`${name}.${ending}`), "poses") as BlendingModel;
    assert.equal(model.blends.kind, kind);
    const session = await BlendingSession.create(core, model);
    const { valueScale } = await Core.create(core, model);
    const isValue = (found: number, value: number) =>
      assert.ok(
        Math.abs(found - value) < 1e-4 * Math.abs(value) + 1e-6 * valueScale,
        `${found}, not ${value}`,
      );
    const shape = new Float32Array(3 * model.space.vertices);
    for (const frame of frames) {
      const report = session.blend(frame.weights);
      assert.equal(report.status, "converged");
      session.solve(); // where the last iteration ends hangs on rounding, and small residuals on that
      isValue(report.value, frame.value);
      reconstruct(model.space, session.q, shape);
      assert.ok(distance(shape, frame.surface) < 1e-4 * diagonal);
      reconstruct(model.poseSpace, frame.weights, shape);
      assert.ok(distance(shape, frame.linear) < 3e-5 * diagonal, "the linear blend of registered poses");
      isCertificate(session.certificate(), frame.certificate, 1e-2);
      assert.deepEqual(session.outside, frame.outside);
      assert.equal(session.certain, frame.certain);
    }
    session.dimension = 7;
    isValue(session.solve().value, leading);
    const endsOf = (poses: number[]) => poses.map((pose) => session.ends(poses, pose));
    areEnds([...endsOf([0, 1, 2]), ...endsOf([0, 1])], ends);
    assert.deepEqual(session.ends([2], 2), [0, 1], "a pose alone has all the weight");
    assert.throws(() => session.blend(model.poses.map(() => 1)), /a sum of one/);
    session.reset();
    assert.ok(session.q.every((x) => x === 0));
  });

/** Ends are whole percents within those of Python; or those of the sampled range, if no test is known. */
function areEnds(ends: readonly (readonly [number, number])[], expected: Ends | null): void {
  const known = expected ?? ends.map(() => [0, 1] as const);
  ends.forEach(([least, greatest], pose) => {
    assert.ok(least > known[pose][0] - 1e-6 && least < known[pose][0] + 0.01, `${ends}, not ${known}`);
    assert.ok(greatest < known[pose][1] + 1e-6 && greatest > known[pose][1] - 0.01, `${ends}, not ${known}`);
  });
}

for (const name of ["blending-cubature", "blending-arap"])
  for (const ending of ["snapspace", "packed"])
    test(`the certain range is that of Python: ${name}.${ending}`, () => {
      const { ways, reaches } = expected<{ ways: number[][]; reaches: number[] }>(`${name}.json`);
      const certain = certainRange(readModel(bytes(`${name}.${ending}`), "poses") as BlendingModel)!;
      ways.forEach((way, i) => {
        const at = (share: number) => way.map((x) => 1 / 3 + share * reaches[i] * x);
        assert.ok(certain.holds(at(1 - 1e-6)) && !certain.holds(at(1 + 1e-6)));
      });
    });

test("where no certain range is known weights go as far as was sampled", () => {
  const model = readModel(bytes("blending.packed"), "poses") as BlendingModel;
  assert.equal(certainRange(model), null);
  assert.deepEqual(weightEnds({ ...model, lowestWeight: -0.1 }, null, [0, 1, 2], 0), [-0.1, 1.2]);
});

for (const name of ["blending", "blending-cubature", "blending-arap"])
  test(`energies of samples are sums over the poses: ${name}`, async () => {
    const model = readModel(bytes(`${name}.packed`), "poses") as BlendingModel;
    const made = await Core.create(core, model);
    const values = new SampleValues(made, model);
    const ofAll = [0.2, 0.5, 0.3];
    for (const weights of [[1, 0, 0], ofAll, [0, 0.4, 0.6], ofAll]) {
      made.setWeights(weights);
      const known = made.value(values.coordinates(2));
      assert.ok(Math.abs(values.at(2, weights) - known) < 1e-11 * (made.valueScale + Math.abs(known)));
      assert.equal(made.value(values.coordinates(2)), known, "the core keeps its weights");
    }
    made.setWeights(ofAll);
    const evaluate = made.value.bind(made);
    let evaluations = 0;
    made.value = (q) => (evaluations++, evaluate(q));
    values.at(2, ofAll);
    assert.equal(evaluations, 0, "known samples cost nothing");
  });
