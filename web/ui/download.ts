import { h } from "./dom.ts";

/** Milliseconds after which the browser has surely begun to write a file. */
const KEPT = 60_000;

/** Gives the user a file, by the browser's download. */
export function download(content: BlobPart, name: string, type: string): void {
  const address = URL.createObjectURL(new Blob([content], { type }));
  downloadFrom(new URL(address), name);
  setTimeout(() => URL.revokeObjectURL(address), KEPT);
}

/** Gives the user what is at an address of the page's own server. */
export function downloadFrom(address: URL, name: string): void {
  const link = h("a", { href: address.href, download: fileName(name), hidden: true });
  document.body.append(link);
  link.click();
  link.remove();
}

/** A name without what file systems refuse. */
function fileName(name: string): string {
  return name.replace(/[\\/:*?"<>|\u0000-\u001f]+/g, "_").replace(/^\.+/, "") || "snapspace";
}
