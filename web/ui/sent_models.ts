import { readModel, type BlendingModel, type PosingModel } from "../engine/index.ts";
import type { Model } from "../engine/messages.ts";
import type { Server } from "./server.ts";

/** Models that the server announces. It keeps few of them, so a page that is slower reads the newest one only. */
export class SentModels {
  #newest: Model | null = null;

  announce(sent: Model): void {
    this.#newest = sent;
  }

  /** The content of a model; null if a newer one was announced. */
  async read(
    sent: Model,
    server: Pick<Server, "fetched">,
    name: string,
  ): Promise<PosingModel | BlendingModel | null> {
    if (sent !== this.#newest) return null;
    try {
      return readModel(await server.fetched(sent.address), name);
    } catch (error) {
      if (sent !== this.#newest) return null; // no longer kept
      throw error;
    }
  }
}
