import assert from "node:assert/strict";
import { test } from "node:test";

import { BlendingSession } from "../blending_session.ts";
import { CertainRange } from "../certain_range.ts";
import { Core } from "../core.ts";
import type { BlendingModel } from "../model.ts";
import { readModel } from "../read_model.ts";
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
  ["blending-shell", "snapspace", "cubature"],
  ["blending-shell", "packed", "cubature"],
  ["blending-arap", "snapspace", "stars"],
  ["blending-arap", "packed", "stars"],
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
    areEnds([...session.ends([0, 1, 2]), ...session.ends([0, 1])], ends);
    assert.deepEqual(session.ends([2]), [[0, 1]], "a pose alone has all the weight");
    assert.throws(() => session.blend(model.poses.map(() => 1)), /a sum of one/);
    session.reset();
    assert.ok(session.q.every((x) => x === 0));
  });

/** In whole percent, inside of those of Python; what was sampled, if no test is known. */
function areEnds(ends: readonly (readonly [number, number])[], expected: Ends | null): void {
  const known = expected ?? ends.map(() => [0, 1] as const);
  ends.forEach(([least, greatest], pose) => {
    assert.ok(least > known[pose][0] - 1e-6 && least < known[pose][0] + 0.01, `${ends}, not ${known}`);
    assert.ok(greatest < known[pose][1] + 1e-6 && greatest > known[pose][1] - 0.01, `${ends}, not ${known}`);
  });
}

test("the certain range is that of Python; where none is known weights go as far as was sampled", async () => {
  const { ways, reaches } = expected<{ ways: number[][]; reaches: number[] }>("blending-cubature.json");
  const model = readModel(bytes("blending-cubature.packed"), "poses") as BlendingModel;
  const certain = CertainRange.of(model)!;
  const start = [1 / 3, 1 / 3, 1 / 3];
  ways.forEach((way, i) => {
    const reach = certain.reach(start, way, 1e3);
    assert.ok(Math.abs(reach / reaches[i] - 1) < 1e-3, `${reach}, not ${reaches[i]}`);
    const at = (share: number) => start.map((w, pose) => w + share * reaches[i] * way[pose]);
    assert.ok(certain.holds(at(1 - 1e-6)) && !certain.holds(at(1 + 1e-6)));
  });
  assert.equal(certain.reach(start, [0, 0, 0], 1e3), 1e3, "no way, no end");
  assert.deepEqual(weightEnds({ ...model, lowestWeight: -0.1 }, null, [0, 1, 2])[0], [-0.1, 1.2]);
});
