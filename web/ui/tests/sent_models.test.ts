import assert from "node:assert/strict";
import { test } from "node:test";

import type { Model } from "../../engine/messages.ts";
import { SentModels } from "../sent_models.ts";

const announced = (number: number): Model => ({
  type: "model",
  request: 1,
  number,
  address: `model/${number}`,
  dimension: 10,
  samples: 20,
  error: null,
  final: false,
  seconds: 1,
});
const gone = new Error("no longer kept");

test("older models are not asked for", async () => {
  const [models, first, second] = [new SentModels(), announced(1), announced(2)];
  models.announce(first);
  models.announce(second);
  const asked: string[] = [];
  const server = {
    fetched: (address: string) => {
      asked.push(address);
      return Promise.resolve(new ArrayBuffer(4));
    },
  };
  assert.equal(await models.read(first, server, "bar"), null);
  assert.deepEqual(asked, []);
  await assert.rejects(models.read(second, server, "bar"), /not a complete Snapspace model/);
  assert.deepEqual(asked, ["model/2"]);
});

test("a model that is gone is no fault if a newer one was announced meanwhile", async () => {
  const [models, first] = [new SentModels(), announced(1)];
  models.announce(first);
  const server = {
    fetched: () => {
      models.announce(announced(2));
      return Promise.reject(gone);
    },
  };
  assert.equal(await models.read(first, server, "bar"), null);
});

test("the newest model must be there", async () => {
  const [models, first] = [new SentModels(), announced(1)];
  models.announce(first);
  await assert.rejects(models.read(first, { fetched: () => Promise.reject(gone) }, "bar"), gone);
});
