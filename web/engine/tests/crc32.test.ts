import assert from "node:assert/strict";
import { test } from "node:test";

import { crc32 } from "../crc32.ts";

test("the checksum is zlib's", () => {
  assert.equal(crc32(new Uint8Array()), "00000000");
  // the check value of every catalogue of CRCs
  assert.equal(crc32(new TextEncoder().encode("123456789")), "cbf43926");
  assert.equal(crc32(new Uint8Array(1000).fill(255)), "e0533230");
});
