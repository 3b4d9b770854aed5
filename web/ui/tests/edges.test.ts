import assert from "node:assert/strict";
import { test } from "node:test";

import { edgesOf } from "../edges.ts";

test("a closed surface has V + F - 2 edges, each once", () => {
  const tetrahedron = new Uint32Array([0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0]);
  const edges = edgesOf(tetrahedron);
  assert.equal(edges.length / 2, 4 + 4 - 2);
  const pairs = new Set(Array.from({ length: 6 }, (_, i) => `${edges[2 * i]} ${edges[2 * i + 1]}`));
  assert.deepEqual([...pairs].sort(), ["0 1", "0 2", "0 3", "1 2", "1 3", "2 3"]);
});

test("the boundary of an open surface has its edges, in whatever direction", () => {
  const edges = edgesOf(new Uint32Array([5, 2, 70_000, 2, 5, 1]));
  const found = Array.from({ length: edges.length / 2 }, (_, i) => [edges[2 * i], edges[2 * i + 1]]);
  assert.deepEqual(found, [
    [1, 2],
    [1, 5],
    [2, 5],
    [2, 70_000],
    [5, 70_000],
  ]);
});
