import assert from "node:assert/strict";
import { test } from "node:test";

import {
  changed,
  choiceOf,
  inOrder,
  lacking,
  losses,
  orderedHandleMessages,
  nameFault,
  withMirrored,
  withMore,
  withNewHandle,
  withoutHandle,
  type Choice,
} from "../choice.ts";
import { changedPart, partMessages, partNameFault, withNewPart, withoutPart } from "../parts.ts";

const select = (choice: Choice, ...selected: number[]): Choice => ({
  ...choice,
  selected: Int32Array.from(selected),
});
const sets = ({ handles }: Choice) => Object.fromEntries(handles.map((h) => [h.name, [...h.vertices]]));

const two = withNewHandle(select(withNewHandle(select(choiceOf([]), 1, 2, 3)), 7, 8));

test("the first handle holds the shape, the others move", () => {
  assert.deepEqual(sets(two), { "handle 1": [1, 2, 3], "handle 2": [7, 8] });
  assert.deepEqual(
    two.handles.map(({ moving }) => moving),
    [false, true],
  );
  assert.equal(two.selected.length, 0);
  assert.equal(lacking(two), "");
});

test("a vertex belongs to one handle, and handles that lose some are reported", () => {
  const three = withNewHandle(select(two, 3, 4, 7, 8));
  assert.deepEqual(sets(three), { "handle 1": [1, 2], "handle 3": [3, 4, 7, 8] });
  assert.equal(
    losses(two, three),
    "Taken from other handles: 1 of handle 1; all of handle 2, which is removed.",
  );
  assert.equal(losses(two, two), "");
  const grown = withMore(select(two, 2, 9), two.handles[1].key);
  assert.deepEqual(sets(grown), { "handle 1": [1, 3], "handle 2": [2, 7, 8, 9] });
  assert.deepEqual(sets(two), { "handle 1": [1, 2, 3], "handle 2": [7, 8] }, "the step before stays");
});

test("names are unique, even those that the user gives", () => {
  const [first, second] = two.handles;
  assert.equal(nameFault(two, second.key, "head"), "");
  assert.equal(nameFault(two, second.key, second.name), "");
  assert.match(nameFault(two, second.key, ` ${first.name} `), /already/);
  assert.match(nameFault(two, second.key, "  "), /needs a name/);
  const named = changed(two, second.key, { name: "handle 3" });
  assert.equal(withNewHandle(select(named, 20)).handles[2].name, "handle 4");
});

test("what must still be chosen is named", () => {
  const [first, second] = two.handles;
  assert.match(lacking(choiceOf([])), /stays in place/);
  assert.match(lacking(withoutHandle(two, second.key)), /part to move/);
  assert.match(lacking(changed(two, first.key, { moving: true })), /must be fixed/);
  assert.match(lacking(changed(two, second.key, { moving: false })), /must move/);
});

test("the server gets the fixed ones first, and what it gave comes back the same", () => {
  const swapped = changed(changed(two, two.handles[0].key, { moving: true }), two.handles[1].key, {
    moving: false,
    angle: [0.1, 0.2, 0.3],
  });
  const message = orderedHandleMessages(swapped.handles);
  assert.deepEqual(
    message.map(({ name, moving }) => [name, moving]),
    [
      ["handle 2", false],
      ["handle 1", true],
    ],
  );
  assert.deepEqual(message[0], {
    name: "handle 2",
    vertices: [7, 8],
    moving: false,
    translation: null,
    angle: [0.1, 0.2, 0.3],
  });
  assert.deepEqual(orderedHandleMessages(choiceOf(message).handles), message);
  assert.equal(inOrder(swapped.handles)[0].name, "handle 2");
});

test("parts are made of the selection, beside handles and over each other", () => {
  const stiff = withNewPart(select(two, 2, 3, 9), 10);
  const both = withNewPart(select(stiff, 3, 4), 0.1);
  assert.deepEqual(sets(both), sets(two), "handles keep their vertices");
  assert.deepEqual(partMessages(both.parts), [
    { name: "stiff 1", vertices: [2, 3, 9], factor: 10 },
    { name: "soft 1", vertices: [3, 4], factor: 0.1 },
  ]);
  assert.equal(both.selected.length, 0);
  const [first, second] = both.parts;
  assert.match(partNameFault(both, second.key, first.name), /already/);
  assert.match(partNameFault(both, second.key, " "), /needs a name/);
  assert.equal(partNameFault(both, second.key, second.name), "");
  assert.equal(changedPart(both, second.key, { factor: 0.5 }).parts[1].factor, 0.5);
  assert.deepEqual(withoutPart(both, first.key).parts, [second]);
  const more = withNewHandle(select(both, 30, 31, 32));
  assert.equal(more.parts, both.parts);
  assert.equal(withMore(select(both, 30), two.handles[0].key).parts, both.parts);
  assert.equal(withNewPart(select(withoutPart(both, first.key), 1), 3).parts[1].name, "stiff 1");
});

test("the mirror image of a handle is added, or replaces the handle of its name", () => {
  const [first, second] = two.handles;
  const image = { name: "right", vertices: [8, 9, 3], moving: false, translation: null, angle: null };
  const added = withMirrored(two, first.key, image)!;
  assert.deepEqual(sets(added), { "handle 1": [1, 2, 3], "handle 2": [7], right: [8, 9] });
  assert.equal(added.handles[2].moving, false);
  const replaced = withMirrored(added, second.key, { ...image, vertices: [1, 5] })!;
  assert.deepEqual(sets(replaced), { "handle 1": [2, 3], "handle 2": [7], right: [1, 5] });
  assert.equal(replaced.handles[2].key, added.handles[2].key);
  assert.equal(withMirrored(two, first.key, { ...image, vertices: [1, 2] }), null);
});
