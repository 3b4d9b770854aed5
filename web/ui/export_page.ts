import type { Model as Sent } from "../engine/messages.ts";
import { downloadFrom } from "./download.ts";

/** Gives the user a page in one file with a model of a workspace; the server makes it. */
export function exportPage({ sent, content }: { sent: Sent; content: { name: string } }): void {
  const address = new URL(sent.address.replace(/^model/, "page"), location.href);
  downloadFrom(address, `${content.name}.html`);
}
