import assert from "node:assert/strict";
import { test } from "node:test";

import { Improving } from "../improving.ts";

function point(number: number) {
  const [shares, reach] = [[1, 0, 0] as const, [0, 0, 0] as const];
  return { name: `point ${number}`, corners: [0, 1, 2], shares, reach };
}

/** A queue, and what it asked of the server. */
function recorded() {
  const orders: string[] = [];
  const improving = new Improving({
    order: (points) => orders.push(points.map(({ name }) => name).join("+")),
    cancel: () => orders.push("cancel"),
  });
  return { improving, orders };
}

test("points that are kept meanwhile are ordered together once a model has the first", () => {
  const { improving, orders } = recorded();
  improving.keep([point(1)]);
  improving.keep([point(1), point(2)]);
  improving.keep([point(1), point(2), point(3)]);
  assert.deepEqual(orders, ["point 1"]);
  assert.match(improving.text, /improved for point 1\. Next: point 2, point 3\./);
  improving.arrived();
  improving.keep([point(2), point(3)]); // the page shows it
  assert.deepEqual(orders, ["point 1", "point 2+point 3"]);
  improving.arrived();
  improving.keep([]);
  assert.equal(improving.text, "");
  assert.equal(orders.length, 2);
});

test("a point that fails stays soft, others are tried, and the user can ask again", () => {
  const { improving, orders } = recorded();
  improving.keep([point(1)]);
  improving.keep([point(1), point(2)]);
  improving.failed();
  assert.deepEqual(orders, ["point 1", "point 2"]);
  assert.match(improving.text, /Soft, but usable: point 1\./);
  assert.equal(improving.canRetry, false, "not while something else is computed");
  improving.arrived();
  improving.keep([point(1)]);
  assert.equal(orders.length, 2);
  assert.equal(improving.canRetry, true);
  improving.retry();
  assert.deepEqual(orders.slice(2), ["point 1"]);
});

test("after a cancel nothing is computed until another point is kept", () => {
  const { improving, orders } = recorded();
  improving.keep([point(1)]);
  improving.keep([point(1), point(2)]);
  improving.cancelled();
  assert.deepEqual(orders, ["point 1"]);
  improving.keep([point(1), point(2), point(3)]);
  assert.deepEqual(orders, ["point 1", "point 3"]);
});

test("letting go of what was ordered cancels it, and its name is free again", () => {
  const { improving, orders } = recorded();
  improving.keep([point(1)]);
  improving.keep([]);
  assert.deepEqual(orders, ["point 1", "cancel"]);
  improving.cancelled();
  improving.keep([point(1)]);
  improving.failed();
  improving.keep([]);
  improving.keep([point(1)]);
  assert.deepEqual(orders, ["point 1", "cancel", "point 1", "point 1"]);
});
