import { defineConfig } from "vite";

import { core } from "./vite.core.ts";
import { notices } from "./vite.notices.ts";
import { threeSources, withoutColorNames } from "./vite.three.ts";

// The file of the npm package.
export default defineConfig({
  plugins: [core(), notices(), withoutColorNames()],
  resolve: { alias: [threeSources] },
  build: {
    target: "es2022",
    emptyOutDir: false,
    reportCompressedSize: false,
    chunkSizeWarningLimit: 1_000,
    lib: {
      entry: "viewer/index.ts",
      formats: ["es"],
      fileName: () => "snapspace-viewer.js",
    },
    rolldownOptions: { output: { minify: true } },
  },
});
