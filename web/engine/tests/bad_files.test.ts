import assert from "node:assert/strict";
import { test } from "node:test";

import { Core } from "../core.ts";
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

test("a file that is not a model is refused", () => {
  refused(new ArrayBuffer(0), /fewer than 8 bytes/);
  refused(
    new TextEncoder().encode("solid teapot, no model at all").buffer as ArrayBuffer,
    /header is cut off/,
  );
  refused(container("not json"), /not JSON/);
  refused(container({ __metadata__: { format: "other" } }), /not a Snapspace model/);
  refused(container({ __metadata__: { format: "snapspace-model", version: "99" } }), /version 99/);
  refused(
    container({ __metadata__: { format: "snapspace-page", version: "1" } }),
    /version 1, and .* reads version 2. Open it/,
  );
  refused(container({ a: { dtype: "F64", shape: [3], data_offsets: [0, 24] } }, 8), /'a' is cut off/);
  for (const entry of [
    null,
    7,
    {},
    { dtype: "F64", shape: [1] },
    { dtype: "F64", shape: 1, data_offsets: [0, 8] },
  ])
    refused(container({ a: entry }, 8), /'a' is cut off or of an unknown type/);
  for (const offsets of [
    [-8, 0],
    [0.5, 8.5],
    [0, 8, 8],
  ])
    refused(container({ a: { dtype: "F64", shape: [1], data_offsets: offsets } }, 8), /'a' is cut off/);
  refused(container("[1]"), /header is not an object/);
  refused(container({ __metadata__: 3 }), /metadata is not an object/);
  refused(container({ __metadata__: { format: "snapspace-model", version: "9\n9" } }), /version 9 9,/);
  refused(container({ a: { dtype: "BF16", shape: [1], data_offsets: [0, 2] } }, 2), /unknown type/);
});

for (const [file, name] of [
  ["posing.snapspace", "handle_K"],
  ["posing.packed", "handle_K"],
  ["blending.snapspace", "quartics"],
  ["blending.packed", "quartics"],
  ["surface-arap.snapspace", "stars_remainder"],
  ["blending-arap.snapspace", "stars_forms"],
  ["surface-radius.snapspace", "stars_triangles"],
  ["surface-radius.snapspace", "estimator_stars_shares"],
  ["blending-radius.packed", "estimator_part_vectors"],
])
  test(`a file that is cut off or altered is refused: ${file}`, () => {
    const whole = bytes(file);
    for (const share of [0.001, 0.1, 0.5, 0.999])
      refused(whole.slice(0, Math.floor(share * whole.byteLength)), /not a complete/);
    const size = Number(new DataView(whole).getBigUint64(0, true));
    const header = new TextDecoder().decode(new Uint8Array(whole, 8, size));
    const renamed = header.replace(`"${name}"`, `"${"x".repeat(name.length)}"`);
    const altered = whole.slice(0);
    new Uint8Array(altered).set(new TextEncoder().encode(renamed), 8);
    refused(altered, new RegExp(`'${name}' is missing`));
  });

test("an energy without a minimum at rest is refused", async () => {
  const model = readModel(bytes("posing.packed"), "") as PosingModel;
  const elastic = {
    kind: "quartic",
    coefficients: new Float64Array(coefficientCount(model.dimension)),
  } as const;
  const damaged = { ...model, elastic, K: model.K.map(() => 0) };
  await assert.rejects(PosingSession.create(core, damaged), /no minimum at rest/);
});

for (const file of [
  "posing.snapspace",
  "posing.packed",
  "cubature.snapspace",
  "cubature.packed",
  "blending.packed",
])
  test(`a material that the core does not know is named: ${file}`, async () => {
    const model = readModel(bytes(file), "") as PosingModel;
    const unknown = { ...model, material: "mud" };
    await assert.rejects(Core.create(core, unknown), (error) => {
      assert.ok(error instanceof UnreadableModel);
      return /of material 'mud', which this page does not know. Open it with the version of Snapspace/.test(
        error.message,
      );
    });
  });

test("moduli that do not fit the material are refused", async () => {
  const model = readModel(bytes("cubature.packed"), "") as PosingModel;
  const { elastic } = model;
  assert.equal(elastic.kind, "cubature");
  if (elastic.kind !== "cubature") return;
  const create = (moduli: Float64Array<ArrayBuffer> | Record<string, unknown>, rows = 1) =>
    Core.create(core, {
      ...model,
      elastic: { ...elastic, material: { kind: "stable-neo-hookean", rows, moduli } },
    });
  await create({ lam: 1, mu: 1 });
  for (const moduli of [Float64Array.of(1), Float64Array.of(1, NaN), { lam: 1 }, { lam: null, mu: 1 }, {}])
    await assert.rejects(create(moduli), /no moduli that fit 'stable-neo-hookean'. Build it again/);
  await assert.rejects(create(Float64Array.of(1, 1), 2), /no moduli that fit/);
  await assert.rejects(create(Float64Array.of(1, -1)), /does not fit the page's core/);
});
