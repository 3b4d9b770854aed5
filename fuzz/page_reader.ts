/** Reads files, whose paths come line by line on the standard input, and prints the outcome of each. */
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";

import { UnreadableModel } from "../web/engine/errors.ts";
import { readModel } from "../web/engine/read_model.ts";

const MOST_BYTES = 1 << 30;

function outcome(path: string): string {
  const file = readFileSync(path);
  const bytes = new Uint8Array(file).buffer;
  try {
    const model = readModel(bytes, "fuzzed");
    if (!(model.dimension >= 0)) return "a model without a dimension";
  } catch (error) {
    if (!(error instanceof UnreadableModel)) return `${String(error)} ${(error as Error).stack}`;
    if (!error.message || error.message.includes("\n")) return `not one line: ${error.message}`;
    return `refused: ${error.message}`;
  }
  return "read";
}

for await (const path of createInterface({ input: process.stdin })) {
  const answer = outcome(path);
  const used = process.memoryUsage.rss();
  console.log((used > MOST_BYTES ? `${used} bytes in use after: ${answer}` : answer).replaceAll("\n", " "));
}
