import base64 from "virtual:core";

/** core/online as WebAssembly. */
export async function coreBytes(): Promise<ArrayBuffer> {
  const compressed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  return new Response(
    new Blob([compressed]).stream().pipeThrough(new DecompressionStream("gzip")),
  ).arrayBuffer();
}

/** core/online, compiled. Rejects with a CompileError in browsers that lack SIMD. */
export async function compiledCore(): Promise<WebAssembly.Module> {
  return WebAssembly.compile(await coreBytes());
}
