import base64 from "virtual:core";

/** core/online as WebAssembly. */
export function coreBytes(): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
}
