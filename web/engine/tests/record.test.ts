import assert from "node:assert/strict";
import { test } from "node:test";

import type { PosingModel } from "../model.ts";
import { readModel } from "../read_model.ts";
import { paintedOwners, upOf } from "../read_record.ts";
import { bytes, expected } from "./expected.ts";

for (const file of ["own_surface.snapspace", "own_surface.packed"])
  test(`handles look as they were painted, with the axis up that was saved: ${file}`, () => {
    const model = readModel(bytes(file), "bar") as PosingModel;
    const owners = new Int32Array(model.space.vertices).fill(-1);
    expected<number[][]>("painted.json").forEach((own, handle) =>
      own.forEach((vertex) => (owners[vertex] = handle)),
    );
    assert.deepEqual([...model.handleOfVertex], [...owners]);
    assert.equal(model.up, "x");
  });

test("a record without an axis, or with anything else in its place, gives none", () => {
  assert.equal((readModel(bytes("posing.snapspace"), "bar") as PosingModel).up, undefined);
  for (const up of [undefined, null, "w", 1, ["x"], {}]) assert.deepEqual(upOf({ up }, "scan.stl"), {});
});

test("without an axis in the record, the usual one for the surface's file is up", () => {
  for (const file of ["a.obj", "a.GLB", "b.gltf"]) {
    assert.deepEqual(upOf({}, file), { up: "y" });
    assert.deepEqual(upOf({ up: "z" }, file), { up: "z" });
  }
  for (const file of ["a.stl", "a.ply", "a.off", "obj", undefined, 3]) assert.deepEqual(upOf({}, file), {});
});

test("painted vertices that do not fit are left aside", () => {
  const own = paintedOwners({ painted: { a: [0], b: [2, 3] } }, ["a", "b"], 5);
  assert.deepEqual([...own!], [0, -1, 1, 1, -1]);
  for (const b of [undefined, 3, [5], [-1], [0.5], ["0"], [NaN], { length: 1 }])
    assert.equal(paintedOwners({ painted: { a: [0], b } }, ["a", "b"], 5), null);
  for (const painted of [undefined, null, 3, "ab", []])
    assert.equal(paintedOwners({ painted }, ["a"], 5), null);
  assert.equal(paintedOwners({ painted: {} }, ["constructor"], 5), null);
});
