import type { Plugin } from "vite";
import { defineConfig } from "vite";

import { core } from "./vite.core.ts";
import { notices } from "./vite.notices.ts";
import { threeSources, withoutColorNames } from "./vite.three.ts";

/** Puts the script and the style into the page, so that it is one file that opens from a disk. */
function oneFile(): Plugin {
  return {
    name: "one-file",
    enforce: "post",
    generateBundle(_, bundle) {
      const page = bundle["index.html"];
      if (page?.type !== "asset") throw new Error("there is no index.html");
      let html = String(page.source);
      for (const [name, part] of Object.entries(bundle)) {
        if (part === page) continue;
        const code = part.type === "chunk" ? part.code : String(part.source);
        const tag =
          part.type === "chunk"
            ? /<script[^>]*\ssrc="[^"]*"[^>]*><\/script>/
            : /<link rel="stylesheet"[^>]*>/;
        if (!tag.test(html)) throw new Error(`nothing in the page asks for ${name}`);
        html = html.replace(tag, "");
        // a function: replacement patterns such as $& occur in code
        if (part.type === "chunk") {
          const script = `<script type="module">${code.replace(/<\/script/g, "<\\/script")}</script>`;
          html = html.replace("</body>", () => `${script}\n  </body>`);
        } else {
          html = html.replace("</head>", () => `<style>${code}</style>\n  </head>`);
        }
        delete bundle[name];
      }
      page.source = html;
    },
  };
}

export default defineConfig({
  plugins: [core(), notices(), withoutColorNames(), oneFile()],
  resolve: { alias: [threeSources] },
  build: {
    target: "es2022",
    outDir: "dist",
    assetsInlineLimit: 1_000_000,
    cssCodeSplit: false,
    modulePreload: false,
    chunkSizeWarningLimit: 1_000,
    reportCompressedSize: false,
  },
});
