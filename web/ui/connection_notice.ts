import { h } from "./dom.ts";
import type { Connection, Server } from "./server.ts";

/** Reports once that the connection to the server is lost, and what helps; shown above every view. */
export class ConnectionNotice {
  readonly element = h("div", { id: "connection", role: "alert", hidden: true });
  readonly #server: Server;

  constructor(server: Server) {
    this.#server = server;
  }

  show(connection: Connection): void {
    this.element.hidden = connection === "open";
    const parts: (Node | string)[] = {
      open: () => [],
      lost: () => [
        h(
          "p",
          {},
          "No connection to the server; trying again. You can still choose and pose, but not compute, save or polish.",
        ),
      ],
      refused: () => [
        h("p", {}, "The server was restarted and has another token. Paste the address that it printed."),
        this.#field(),
      ],
      elsewhere: () => [
        h("p", {}, "This work is open in another tab now."),
        h("button", { type: "button", onclick: () => this.#server.connect() }, "Use it here"),
      ],
    }[connection]();
    this.element.replaceChildren(...parts);
  }

  #field(): HTMLElement {
    const input = h("input", { type: "text", required: true, spellcheck: false, autocomplete: "off" });
    input.setAttribute("aria-label", "Address or token of the server");
    input.placeholder = "http://127.0.0.1:…/?token=…";
    const form = h("form", { className: "row" }, input, h("button", { type: "submit" }, "Connect"));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#server.renew(input.value.trim());
    });
    return form;
  }
}
