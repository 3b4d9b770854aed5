import assert from "node:assert/strict";
import { test } from "node:test";

import { isFound, nameInGroup, poseGroups, prefixOf } from "../pose_groups.ts";

test("a name begins before its digits, or else before its last dash or underscore", () => {
  const prefixes = {
    "lion-01": "lion",
    lion7: "lion",
    "pose 11": "pose",
    lion_run: "lion",
    "horse-gallop-03": "horse-gallop",
    "horse-gallop-left": "horse-gallop",
    "take-2-final": "take-2",
    rest: "",
    "look round": "",
    "007": "",
  };
  for (const [name, prefix] of Object.entries(prefixes)) assert.equal(prefixOf(name), prefix, name);
});

test("each pose is in one group, and a group has two at least", () => {
  const names = ["cat-01", "rest", "lion-01", "cat-02", "wolf-01", "lion-02", "007"];
  assert.deepEqual(poseGroups(names), [
    { name: "cat", poses: [0, 3] },
    { name: "lion", poses: [2, 5] },
    { name: "", poses: [1, 4, 6] },
  ]);
  assert.deepEqual(poseGroups(["a", "b"]), [{ name: "", poses: [0, 1] }]);
});

test("in its group a pose is named by what differs", () => {
  const [group] = poseGroups(["cat-01", "cat-02"]);
  assert.equal(nameInGroup("cat-01", group), "01");
  const [others] = poseGroups(["rest", "run"]);
  assert.equal(nameInGroup("rest", others), "rest");
});

test("a search finds its words in any order and case", () => {
  assert.ok(isFound("Lion_run-03", "03 lion"));
  assert.ok(isFound("rest", " "), "nothing is searched for");
  assert.ok(!isFound("Lion_run-03", "lion 04"));
});
