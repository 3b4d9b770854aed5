import assert from "node:assert/strict";
import { test } from "node:test";

import { LocalRatios } from "../local_ratios.ts";

test("equal ratios are the estimate and the bound everywhere", () => {
  const ratios = new LocalRatios(Float64Array.from([0, 1, 2, 5]), Float64Array.from([3, 3, 3, 3]));
  for (const q of [[0], [1.5], [100]]) {
    const [middle, bound] = ratios.at(q, 0.8);
    assert.ok(Math.abs(middle - 3) < 1e-12 && Math.abs(bound! - 3) < 1e-12);
  }
});

test("a confidence that takes more frames has no bound", () => {
  const ratios = new LocalRatios(Float64Array.from([0, 1, 2]), Float64Array.from([1, 2, 3]));
  assert.equal(ratios.at([0], 0.9)[1], null);
  assert.ok(ratios.at([0], 0.75)[1]! > 1);
});

test("ratios that change with the frame are followed", () => {
  const coordinates = Float64Array.from({ length: 40 }, (_, i) => i / 10);
  const ratios = new LocalRatios(coordinates, coordinates.map(Math.exp));
  assert.ok(Math.abs(Math.log(ratios.at([1], 0.5)[0]) - 1) < 0.3);
  assert.ok(Math.abs(Math.log(ratios.at([3], 0.5)[0]) - 3) < 0.3);
});
