import { defineConfig } from "vite";

import { core } from "./vite.core.ts";

// Two files of the npm package: one that imports three.js, and with `--mode bundle` one that contains it.
export default defineConfig(({ mode }) => ({
  plugins: [core()],
  build: {
    target: "es2022",
    emptyOutDir: false,
    reportCompressedSize: false,
    chunkSizeWarningLimit: 1_000,
    lib: {
      entry: "viewer/index.ts",
      formats: ["es"],
      fileName: () => (mode === "bundle" ? "snapspace-viewer.bundle.js" : "snapspace-viewer.js"),
    },
    rolldownOptions: {
      external: mode === "bundle" ? [] : [/^three(\/|$)/],
      output: { minify: true },
    },
  },
}));
