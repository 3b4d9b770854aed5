import { h, section } from "./dom.ts";

/** What was mended or left out when the mesh was made; empty if nothing was. */
export function meshNotes(notices: readonly string[]): HTMLElement[] {
  if (notices.length === 0) return [];
  const list = h("ul", { className: "notes" }, ...notices.map((notice) => h("li", {}, `${notice}.`)));
  return [section("Please note", list)];
}
