import type { Plugin } from "vite";

/** three.js by its sources: a module that nobody imports is left out. From the file that three.js is built into, bundlers
 * keep all that might have side effects. */
export const threeSources = { find: /^three$/, replacement: "three/src/Three.Core.js" };

/** Leaves out the names of CSS colours, a table in three.js that nobody uses here: colours are numbers, #rrggbb or rgb(). */
export function withoutColorNames(): Plugin {
  return {
    name: "without-color-names",
    transform(code, id) {
      if (!id.endsWith("/three/src/math/Color.js")) return null;
      const table = /const _colorKeywords = \{[^}]*\};/;
      if (!table.test(code)) throw new Error("three.js has no table of the names of colours any more");
      return { code: code.replace(table, "const _colorKeywords = {};"), map: null };
    },
  };
}
