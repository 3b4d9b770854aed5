import { readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

import type { Plugin } from "vite";

/** The module "virtual:core": web/generated/core.wasm, compressed by gzip, in base64. */
export function core(): Plugin {
  return {
    name: "core",
    resolveId: (id) => (id === "virtual:core" ? `\0${id}` : undefined),
    load: (id) =>
      id === "\0virtual:core"
        ? `export default "${gzipSync(readFileSync(new URL("generated/core.wasm", import.meta.url)), { level: 9 }).toString("base64")}"`
        : undefined,
  };
}
