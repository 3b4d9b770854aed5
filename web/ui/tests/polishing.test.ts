import assert from "node:assert/strict";
import { test } from "node:test";

import type { Posing } from "../posing.ts";
import { Polishing } from "../polishing.ts";

/** How often a frame with these coordinates is polished. */
async function timesPolished(q: number[]): Promise<number> {
  const session = { q, model: { coordinateScale: 1, handles: [] } };
  const posing = { session, surface: {}, stage: {}, pulled: null, jiggle: { isHeavy: false } };
  let times = 0;
  const polish = () => {
    times++;
    return new Promise<never>(() => {});
  };
  void new Polishing(
    posing as unknown as Posing,
    polish,
    () => {},
    () => {},
  ).ask();
  return times;
}

test("what a solve leaves of a far motion counts as rest", async () => {
  assert.equal(await timesPolished([2e-6, 0]), 0, "it would say that the polish moved all of it");
  assert.equal(await timesPolished([1e-3, 0]), 1, "a small displacement is polished");
});
