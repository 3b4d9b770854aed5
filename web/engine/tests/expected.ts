import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";

import type { Certificate } from "../certificate.ts";

/** Models and numbers that Python's Session made for these tests (tests/page/test_engine.py). */
const folder = process.env["SNAPSPACE_EXPECTED"];
if (!folder) throw new Error("run tests/page/test_engine.py: it writes what these tests compare with");

export function bytes(name: string): ArrayBuffer {
  const content = readFileSync(join(folder!, name));
  return content.buffer.slice(content.byteOffset, content.byteOffset + content.byteLength) as ArrayBuffer;
}

export function expected<T>(name: string): T {
  return JSON.parse(readFileSync(join(folder!, name), "utf-8")) as T;
}

export const core = await WebAssembly.compile(
  readFileSync(new URL("../../generated/core.wasm", import.meta.url)),
);

/** The largest difference of two rows of numbers; NaN counts as infinite. */
export function distance(a: ArrayLike<number>, b: ArrayLike<number>): number {
  if (a.length !== b.length) return Infinity;
  let most = 0;
  for (let i = 0; i < a.length; i++) {
    const difference = Math.abs(a[i] - b[i]);
    if (!(difference <= most)) most = Number.isNaN(difference) ? Infinity : difference;
  }
  return most;
}

/** Asserts that a certificate is Python's [relative, upper], or null as that. At a pose the residual is what solves leave. */
export function isCertificate(
  found: Certificate | null,
  wanted: [number, number] | null,
  tolerance: number,
): void {
  assert.equal(found === null, wanted === null);
  if (!found || !wanted) return;
  [found.relative, found.upper!].forEach((share, i) =>
    assert.ok(Math.abs(share - wanted[i]) < tolerance * wanted[i] + 1e-6, `${share}, not ${wanted[i]}`),
  );
}
