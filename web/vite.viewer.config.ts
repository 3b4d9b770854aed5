import { defineConfig } from "vite";

import { core } from "./vite.core.ts";
import { notices } from "./vite.notices.ts";
import { threeSources } from "./vite.three.ts";

// The file of the npm package.
export default defineConfig({
  plugins: [core(), notices()],
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
