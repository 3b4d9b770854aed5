import { readdirSync, readFileSync } from "node:fs";

import type { Plugin } from "vite";

/** Puts the licences of the packages that a script contains at its beginning, as they require. */
export function notices(): Plugin {
  return {
    name: "notices",
    generateBundle(_, bundle) {
      for (const part of Object.values(bundle)) {
        if (part.type !== "chunk") continue;
        const found = Object.keys(part.modules).map((id) => /node_modules\/([^/]+)\//.exec(id)?.[1]);
        const packages = [...new Set(found)].filter((name) => name !== undefined).sort();
        const texts = packages.map((name) => `This file contains ${name}.\n\n${licenceOf(name)}`);
        if (texts.length > 0) part.code = `/*!\n${texts.join("\n\n")}\n*/\n${part.code}`;
      }
    },
  };
}

function licenceOf(name: string): string {
  const folder = new URL(`node_modules/${name}/`, import.meta.url);
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${name} has no licence`);
  return readFileSync(new URL(file, folder), "utf-8").trim();
}
