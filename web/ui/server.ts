import { UnreadableModel } from "../engine/index.ts";
import { keepQuery } from "./address.ts";
import type { Failed, PageMessage, ServerMessage } from "../engine/messages.ts";

/** A message to the server before the connection numbers it. */
type Unnumbered<M> = M extends PageMessage ? Omit<M, "request"> : never;
export type Request = Unnumbered<PageMessage>;
export type Answer<T extends ServerMessage["type"]> = Extract<ServerMessage, { type: T }>;

/** An answer, and the bytes that came before it, if any. */
export interface Reply<T extends ServerMessage["type"]> {
  readonly message: Answer<T>;
  readonly bytes: ArrayBuffer | null;
}

/** The server refused a request; the message is in its words. */
export class Refused extends Error {}

interface Waiting {
  type: string;
  resolve(answer: unknown): void;
  reject(error: Error): void;
}

/** Open; lost, and tried again; refused, because the server has another token; or taken over by another page. */
export type Connection = "open" | "lost" | "refused" | "elsewhere";

const TAKEN_OVER = 4001; // as snapspace/server/live.py closes connections
const PAUSES = [0.5, 1, 2, 4, 8]; // seconds before the connection is tried again

/** The connection to the server of `snapspace view`. A lost connection is opened again, to the same workspace if the
 * server still has it. */
export class Server {
  /** Called once after every change of the connection. */
  onConnection: (connection: Connection) => void = () => {};
  readonly #address: URL;
  readonly #listeners = new Map<string, Set<(message: never) => void>>();
  readonly #waiting = new Map<number, Waiting>();
  #socket: WebSocket | null = null;
  #bytes: { request: number; content: ArrayBuffer } | null = null;
  #requests = 0;
  #tries = 0;
  #connection: Connection | null = null;
  #retry = 0;

  /** The server that the page came from; null where it came from a file, or serves pages only. */
  static ofPage(): Server | null {
    const named = document.querySelector<HTMLMetaElement>('meta[name="snapspace-server"]')?.content;
    return named ? new Server(named) : null;
  }

  constructor(address: string) {
    this.#address = new URL(address, location.href);
    this.#address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    const workspace = new URLSearchParams(location.search).get("workspace");
    if (workspace) this.#address.searchParams.set("workspace", workspace);
    this.on("workspace", ({ id, job }) => {
      this.#address.searchParams.set("workspace", id);
      keepQuery("workspace", id);
      this.#requests = Math.max(this.#requests, job ?? 0); // requests of the page before it was reloaded
    });
  }

  get isOpen(): boolean {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /** Connects; listeners should be there by now. */
  connect(): void {
    clearTimeout(this.#retry);
    const socket = new WebSocket(this.#address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.#tries = 0;
      this.#report("open");
    };
    socket.onmessage = ({ data }) => this.#take(data);
    socket.onclose = ({ code }) => {
      if (socket === this.#socket) void this.#lost(code);
    };
    this.#socket = socket;
  }

  /** Calls `act` for every message of a type, until the signal. */
  on<T extends ServerMessage["type"]>(
    type: T,
    act: (message: Answer<T>) => void,
    signal?: AbortSignal,
  ): void {
    const listeners = this.#listeners.get(type) ?? new Set();
    this.#listeners.set(type, listeners.add(act));
    signal?.addEventListener("abort", () => listeners.delete(act));
  }

  /** Sends a message and returns its number, which answers repeat. Refused without a connection. */
  send(message: Request): number {
    if (!this.isOpen) throw new Refused("There is no connection to the server.");
    const request = this.number();
    this.#socket!.send(JSON.stringify({ ...message, request }));
    return request;
  }

  /** The number of the next message, or of an upload. */
  number(): number {
    return ++this.#requests;
  }

  /** Sends a message and waits for its answer of a type, until the signal. Refused if the server cannot, or is lost. */
  ask<T extends ServerMessage["type"]>(message: Request, type: T, signal?: AbortSignal): Promise<Reply<T>> {
    return new Promise((resolve, reject) => {
      const request = this.send(message);
      signal?.addEventListener("abort", () => {
        if (this.#waiting.delete(request)) reject(new Refused("A newer request replaced this one."));
      });
      this.#waiting.set(request, { type, resolve: resolve as (answer: unknown) => void, reject });
    });
  }

  /** The bytes at an address that the server named. */
  async fetched(address: string): Promise<ArrayBuffer> {
    const answer = await fetch(new URL(address, location.href)).catch(() => null);
    if (!answer?.ok) throw new UnreadableModel(await refusal(answer));
    return answer.arrayBuffer();
  }

  /** An address of the server, with the token of the page. */
  address(path: string, query: Record<string, string>): URL {
    const url = new URL(path, location.href);
    const token = this.#address.searchParams.get("token");
    if (token) url.searchParams.set("token", token);
    for (const [key, value] of Object.entries(query)) url.searchParams.set(key, value);
    return url;
  }

  #take(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      this.#bytes = { request: new DataView(data).getInt32(0, true), content: data.slice(4) };
      return;
    }
    const message = JSON.parse(data) as ServerMessage;
    const request = "request" in message ? message.request : 0;
    const waiting = this.#waiting.get(request);
    if (waiting && message.type === "failed") {
      this.#waiting.delete(request);
      waiting.reject(new Refused((message as Failed).message));
      return;
    }
    if (waiting?.type === message.type) {
      this.#waiting.delete(request);
      const bytes = this.#bytes?.request === request ? this.#bytes.content : null;
      waiting.resolve({ message, bytes });
    }
    this.#listeners.get(message.type)?.forEach((act) => act(message as never));
  }

  /** Connects with another token, given alone or in an address, as the server printed it. */
  renew(given: string): void {
    const address = URL.canParse(given) ? new URL(given) : null;
    const token = address?.searchParams.get("token") ?? given;
    if (address && address.host !== location.host) {
      location.href = address.href; // at another port: the page of that server
      return;
    }
    this.#address.searchParams.set("token", token);
    keepQuery("token", token);
    this.connect();
  }

  #report(connection: Connection): void {
    if (connection === this.#connection) return;
    this.#connection = connection;
    this.onConnection(connection);
  }

  async #lost(code: number): Promise<void> {
    this.#waiting.forEach(({ reject }) => reject(new Refused("The connection to the server was lost.")));
    this.#waiting.clear();
    if (code === TAKEN_OVER) return this.#report("elsewhere");
    if (await this.#isRefused()) return this.#report("refused");
    this.#report("lost");
    const pause = PAUSES[Math.min(this.#tries++, PAUSES.length - 1)];
    this.#retry = window.setTimeout(() => this.connect(), 1000 * pause);
  }

  /** Whether the server is there and refuses the token: a websocket does not say why it was closed. */
  async #isRefused(): Promise<boolean> {
    const answer = await fetch(this.address("mesh/-/0", {}), { cache: "no-store" }).catch(() => null);
    return answer?.status === 403;
  }
}

async function refusal(answer: Response | null): Promise<string> {
  if (!answer) return "The server does not answer. Is `snapspace view` still running?";
  const text = await answer.text().catch(() => "");
  return text.startsWith("snapspace") ? text : `The server has nothing there (status ${answer.status}).`;
}
