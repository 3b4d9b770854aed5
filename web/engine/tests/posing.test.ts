import assert from "node:assert/strict";
import { test } from "node:test";

import { Core } from "../core.ts";
import type { PosingModel } from "../model.ts";
import { applied, eulerOfRotation, plus, rotationOfEuler, type Vector } from "../motion.ts";
import { PosingSession } from "../posing_session.ts";
import { readModel } from "../read_model.ts";
import { reconstruct } from "../shape_space.ts";
import { bytes, core, distance, expected, isCertificate } from "./expected.ts";

interface Frame {
  motions: [number, Vector, Vector][];
  value: number;
  q: number[];
  certificate: [number, number] | null;
  surface: number[];
  outside: number[];
}

interface Drag {
  frames: Frame[];
  diagonal: number;
  /** The value in 7 dimensions; null if it is infinite. */
  leading: number | null;
}

const { diagonal } = expected<Drag>("posing.json");

/** The shown surface: tau + U q, carried along by the first handle. */
function surface(session: PosingSession): Float32Array {
  const { space } = session.model;
  const shape = new Float32Array(3 * space.vertices);
  reconstruct(space, session.q, shape);
  const { rotation, shift } = session.carriedBy;
  for (let i = 0; i < shape.length; i += 3)
    shape.set(plus(applied(rotation, [shape[i], shape[i + 1], shape[i + 2]]), shift), i);
  return shape;
}

// every material with other moduli in every tet, and shells
const materials = expected<string[]>("materials.json");
const models = ["posing", "own_surface", "cubature", "clustered", ...materials];
const files = models.flatMap((name) => [`${name}.snapspace`, `${name}.packed`]);
for (const file of files)
  test(`a drag is that of Session: ${file}`, async () => {
    const [name, ending] = file.split(".");
    const { frames, leading } = expected<Drag>(`${name}.json`);
    const model = readModel(bytes(file), "bar") as PosingModel;
    const session = await PosingSession.create(core, model);
    const { valueScale } = await Core.create(core, model);
    // coefficients of the packed model are in single precision; two solves of stiff parts end as near as they must
    const exact = ending === "snapspace" && !materials.includes(name) ? 1e-6 : 1e-5;
    for (const frame of frames) {
      const motions = frame.motions.map(([handle, euler, translation]) => {
        const rotation = rotationOfEuler(euler);
        assert.ok(distance(rotationOfEuler(eulerOfRotation(rotation)), rotation) < 1e-12);
        return [handle, { rotation, translation }] as const;
      });
      const report = session.moveAll(new Map(motions));
      assert.equal(report.status, "converged");
      assert.ok(Math.abs(report.value - frame.value) <= exact * Math.abs(frame.value) + 1e-12 * valueScale);
      assert.ok(distance(session.q, frame.q) < 10 * exact * model.coordinateScale);
      // modes are quantised; the barrier of symmetric Dirichlet leaves the solve fewer digits
      assert.ok(distance(surface(session), frame.surface) < 5e-5 * diagonal);
      isCertificate(session.certificate(), frame.certificate, 1e3 * exact);
      assert.deepEqual(
        session.outside.map(({ handle }) => handle),
        frame.outside,
      );
    }
    session.dimension = 7;
    assert.equal(session.certificate(), null, "calibrated for all dimensions");
    assert.equal(session.q.length, 7);
    if (leading) assert.ok(Math.abs(session.solve().value - leading) < 1e-4 * Math.abs(leading));
    session.reset();
    assert.ok(distance(surface(session), model.space.base) === 0);
  });

for (const file of ["posing.packed", "cubature.packed", "clustered.packed"])
  test(`a jump back from far away ends where one from rest does: ${file}`, async () => {
    const model = readModel(bytes(file), "") as PosingModel;
    const [far, near] = [await PosingSession.create(core, model), await PosingSession.create(core, model)];
    for (const axis of [0, 1, 2]) {
      const away = [0, 0, 0].map((_, i) => (i === axis ? 2 * diagonal : 0)) as unknown as Vector;
      const back = away.map((x) => 0.02 * x) as unknown as Vector;
      far.move(1, [0, 0, 0], away);
      near.reset();
      assert.equal(far.move(1, [0, 0, 0], back).status, "converged");
      const expected = near.move(1, [0, 0, 0], back);
      assert.equal(expected.status, "converged");
      assert.ok(distance(far.q, near.q) < 1e-4 * model.coordinateScale, `axis ${axis}`);
      far.move(1, [0, 0, 0], away);
      assert.equal(far.move(1, [0, 0, 0], [0, 0, 0]).status, "converged");
      assert.ok(distance(far.q, new Float64Array(far.dimension)) < 1e-9 * model.coordinateScale);
    }
  });

test("a motion whose energy overflows is undone", async () => {
  const session = await PosingSession.create(core, readModel(bytes("posing.packed"), "") as PosingModel);
  session.move(1, [0, 0, 0.2], [0.1, 0, 0]);
  const [q, motion] = [session.q, session.motion(1)];
  assert.equal(session.move(1, [0, 0, 0], [1e300, 0, 0]).status, "not_finite");
  assert.deepEqual(session.q, q);
  assert.deepEqual(session.motion(1), motion);
  assert.throws(() => session.move(1, [0, NaN, 0], [0, 0, 0]), RangeError);
  assert.deepEqual(session.motion(1), motion);
  assert.throws(() => (session.dimension = 0), /not between 1 and/);
});

test("the packed model is the file's, on the surface", async () => {
  const file = readModel(bytes("posing.snapspace"), "bar") as PosingModel;
  const packed = readModel(bytes("posing.packed"), "") as PosingModel;
  assert.deepEqual(packed.faces, file.faces);
  assert.deepEqual(packed.handleOfVertex, file.handleOfVertex);
  assert.ok(distance(packed.space.modes, file.space.modes) <= 1);
  assert.ok(distance(packed.handles[1].center, file.handles[1].center) < 1e-12 * diagonal);
  const { valueScale } = await Core.create(core, file);
  assert.ok(Math.abs(valueScale / (packed.valueScale as number) - 1) < 1e-12);
  assert.deepEqual(packed.boxes, file.boxes);
});

for (const file of ["own_boxes.snapspace", "own_boxes.packed"])
  test(`each handle has its own box: ${file}`, async () => {
    const own = expected<{ frames: { share: number; outside: number[] }[]; boxes: number[][] }>(
      "own_boxes.json",
    );
    const model = readModel(bytes(file), "bar") as PosingModel;
    const boxes = model.boxes.map((box) => [...box.translation, ...box.angle]);
    assert.deepEqual(boxes, own.boxes);
    const session = await PosingSession.create(core, model);
    const outside = () => session.outside.map(({ handle }) => handle);
    const scaled = (values: readonly number[], share: number) =>
      [0, 1, 2].map((i) => share * values[i]) as unknown as Vector;
    for (const { share, outside: those } of own.frames) {
      session.move(1, scaled(model.boxes[1].angle, share), scaled(model.boxes[1].translation, share));
      assert.deepEqual(outside(), those);
    }
    session.move(2, [0, 0, 0], [1e-3, 0, 0]);
    assert.deepEqual(outside(), [1, 2]);
  });

test("a gimbal-locked rotation keeps its matrix", () => {
  for (const beta of [Math.PI / 2, -Math.PI / 2]) {
    const rotation = rotationOfEuler([0.3, beta, -1.1]);
    assert.ok(distance(rotationOfEuler(eulerOfRotation(rotation)), rotation) < 1e-12);
  }
});
