interface State {
  readonly request: number;
  readonly isRunning: boolean;
}

/** What the server computes for the page, by the number of the request. A new request replaces the one before once it
 * has begun: one that the server refuses changes nothing. */
export class PageJob {
  #now: State = { request: 0, isRunning: false };
  #before: State | null = null;

  get request(): number {
    return this.#now.request;
  }

  get isRunning(): boolean {
    return this.#now.isRunning;
  }

  /** Sets what the server reports. */
  set(request: number, isRunning: boolean): void {
    [this.#now, this.#before] = [{ request, isRunning }, null];
  }

  /** A request was sent. */
  order(request: number): void {
    [this.#now, this.#before] = [{ request, isRunning: true }, this.#now];
  }

  /** Whether a message is about it, which shows that it has begun. */
  takes(request: number): boolean {
    if (request !== this.#now.request) return false;
    this.#before = null;
    return true;
  }

  /** Whether it is the one that failed; it has then ended. */
  fails(request: number): boolean {
    if (request !== this.#now.request) return false;
    this.#now = this.#before ?? { request, isRunning: false };
    this.#before = null;
    return true;
  }

  /** A request has ended; a later one continues. */
  end(request = this.#now.request): void {
    if (request === this.#now.request) this.set(request, false);
  }
}
