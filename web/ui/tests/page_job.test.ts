import assert from "node:assert/strict";
import { test } from "node:test";

import { PageJob } from "../page_job.ts";

test("a request that is refused leaves the running one", () => {
  const job = new PageJob();
  job.order(3);
  assert.ok(job.takes(3));
  job.order(4);
  assert.equal(job.takes(3), false, "it is being replaced");
  assert.ok(job.fails(4));
  assert.equal(job.request, 3);
  assert.ok(job.isRunning && job.takes(3));
});

test("a request that has begun and fails ends all work", () => {
  const job = new PageJob();
  job.order(3);
  job.takes(3);
  job.order(4);
  job.takes(4);
  assert.equal(job.fails(3), false);
  assert.ok(job.fails(4));
  assert.equal(job.isRunning, false);
});

test("the end of an older request is not that of a later one", () => {
  const job = new PageJob();
  job.order(3);
  job.takes(3);
  job.order(4);
  job.end(3);
  assert.ok(job.isRunning);
  job.end(4);
  assert.equal(job.isRunning, false);
});
