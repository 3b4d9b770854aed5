import assert from "node:assert/strict";
import { test } from "node:test";

import { Core } from "../core.ts";
import { readModel } from "../read_model.ts";
import { bytes, core, expected } from "./expected.ts";

interface At {
  q: number[];
  offsets: number[];
  value: number;
  residual: number;
}

// every registered material, with other moduli in every tet
const all = Object.entries(expected<Record<string, At>>("values.json"));

test("there are materials", () => assert.ok(all.length >= 5));

for (const [kind, { q, offsets, value, residual }] of all)
  for (const ending of ["snapspace", "packed"])
    test(`value and residual are those of Python: ${kind}.${ending}`, async () => {
      const session = await Core.create(core, readModel(bytes(`${kind}.${ending}`), ""));
      session.setOffsets(offsets);
      session.q = q;
      const near = (found: number, wanted: number, tolerance: number) =>
        assert.ok(Math.abs(found / wanted - 1) < tolerance, `${found}, not ${wanted}`);
      near(session.value(q), value, 1e-6); // rows are in single precision
      near(session.residual()!, residual, ending === "packed" ? 1e-5 : 1e-7); // and the packed modes
    });
