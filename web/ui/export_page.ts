import { downloadFrom } from "./download.ts";
import type { Server } from "./server.ts";
import type { Axis } from "./stage.ts";

/** What a page in one file is made of. */
export interface ExportedPage {
  /** The model, by its number at the server. */
  readonly model: number;
  readonly name: string;
  readonly up: Axis;
  /** Content of a timeline file; null without keys. */
  readonly timeline: string | null;
}

/** Gives the user a page in one file; the server makes it. Refused if it cannot. */
export async function exportPage(server: Server, { name, model, up, timeline }: ExportedPage): Promise<void> {
  const { message } = await server.ask({ type: "export", model, up, timeline }, "exported");
  downloadFrom(new URL(message.address, location.href), `${name || "snapspace"}.html`);
}
