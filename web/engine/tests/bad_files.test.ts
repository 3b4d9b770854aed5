import assert from "node:assert/strict";
import { test } from "node:test";

import { PosingSession } from "../posing_session.ts";
import { coefficientCount, type PosingModel } from "../model.ts";
import { readModel } from "../read_model.ts";
import { UnreadableModel } from "../errors.ts";
import { bytes, core } from "./expected.ts";

const refused = (content: ArrayBuffer, message: RegExp) =>
  assert.throws(
    () => readModel(content, "bad"),
    (error) => error instanceof UnreadableModel && message.test(error.message),
  );

/** A container with this JSON header, and `data` zeros. */
function container(header: object | string, data = 0): ArrayBuffer {
  const text = new TextEncoder().encode(typeof header === "string" ? header : JSON.stringify(header));
  const content = new Uint8Array(8 + text.length + data);
  new DataView(content.buffer).setBigUint64(0, BigInt(text.length), true);
  content.set(text, 8);
  return content.buffer;
}

test("what is no model is told", () => {
  refused(new ArrayBuffer(0), /fewer than 8 bytes/);
  refused(
    new TextEncoder().encode("solid teapot, no model at all").buffer as ArrayBuffer,
    /header is cut off/,
  );
  refused(container("not json"), /not JSON/);
  refused(container({ __metadata__: { format: "other" } }), /not a Snapspace model/);
  refused(container({ __metadata__: { format: "snapspace-model", version: "99" } }), /version 99/);
  refused(container({ a: { dtype: "F64", shape: [3], data_offsets: [0, 24] } }, 8), /'a' is cut off/);
  refused(container({ a: { dtype: "BF16", shape: [1], data_offsets: [0, 2] } }, 2), /unknown type/);
});

for (const file of ["posing.snapspace", "posing.packed", "blending.snapspace", "blending.packed"])
  test(`a file that is cut off or altered is told: ${file}`, () => {
    const whole = bytes(file);
    for (const share of [0.001, 0.1, 0.5, 0.999])
      refused(whole.slice(0, Math.floor(share * whole.byteLength)), /not a complete/);
    const size = Number(new DataView(whole).getBigUint64(0, true));
    const header = new TextDecoder().decode(new Uint8Array(whole, 8, size));
    const name = file.startsWith("posing") ? "handle_K" : "quartics";
    const renamed = header.replace(`"${name}"`, `"${"x".repeat(name.length)}"`);
    const altered = whole.slice(0);
    new Uint8Array(altered).set(new TextEncoder().encode(renamed), 8);
    refused(altered, new RegExp(`'${name}' is missing`));
  });

test("an energy without a minimum at rest is told", async () => {
  const model = readModel(bytes("posing.packed"), "") as PosingModel;
  const elastic = {
    kind: "quartic",
    coefficients: new Float64Array(coefficientCount(model.dimension)),
  } as const;
  const damaged = { ...model, elastic, K: model.K.map(() => 0) };
  await assert.rejects(PosingSession.create(core, damaged), /no minimum at rest/);
});
