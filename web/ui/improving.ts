import type { KeptPoint as Message } from "../engine/messages.ts";

/** What improves models: the server of the page. */
export interface Improver {
  /** Orders better models with points as further handles, in place of what is being computed. */
  order(points: readonly Message[]): void;
  /** Stops computing. */
  cancel(): void;
}

/** Lets a server make handles of the points that are kept. Points that are kept meanwhile wait for its first model. */
export class Improving {
  /** After something has changed that a user should know. */
  onChange: () => void = () => {};
  readonly #improver: Improver;
  #kept: readonly Message[] = [];
  /** Names of the points that were ordered, until a model has them. */
  #ordered: readonly string[] = [];
  /** Names of points whose orders failed or were cancelled: they stay soft until the user asks again. */
  readonly #setAside = new Set<string>();

  constructor(improver: Improver) {
    this.#improver = improver;
  }

  /** Sets the points that are kept now. If none of those that were ordered is left, nothing more needs to be computed.
   * */
  keep(points: readonly Message[]): void {
    this.#kept = points;
    const names = points.map(({ name }) => name);
    for (const name of this.#setAside) if (!names.includes(name)) this.#setAside.delete(name);
    if (this.#ordered.length > 0 && !this.#ordered.some((name) => names.includes(name))) {
      this.#ordered = [];
      this.#improver.cancel();
    }
    this.#order();
  }

  /** A model with the points that were ordered has come, and is shown next. */
  arrived(): void {
    this.#ordered = [];
  }

  /** There will be no model with the points that were ordered. Others are tried. */
  failed(): void {
    for (const name of this.#ordered) this.#setAside.add(name);
    this.#ordered = [];
    this.#order();
  }

  /** The user wants nothing to be computed. */
  cancelled(): void {
    for (const { name } of this.#kept) this.#setAside.add(name);
    this.#ordered = [];
    this.onChange();
  }

  /** The view of the points is left; what was ordered is still computed. */
  forget(): void {
    [this.#kept, this.#ordered] = [[], []];
    this.onChange();
  }

  /** Orders the points that were set aside. */
  retry(): void {
    this.#setAside.clear();
    this.#order();
  }

  /** Whether points were set aside, and nothing else is computed for points. */
  get canRetry(): boolean {
    return this.#setAside.size > 0 && this.#ordered.length === 0;
  }

  /** What is done for the points that are kept; empty without any. */
  get text(): string {
    const names = this.#kept.map(({ name }) => name);
    const soft = names.filter((name) => this.#setAside.has(name));
    const waiting = names.filter((name) => !soft.includes(name) && !this.#ordered.includes(name));
    const parts = [];
    if (this.#ordered.length > 0) parts.push(`The model is being improved for ${this.#ordered.join(", ")}.`);
    if (waiting.length > 0) parts.push(`Next: ${waiting.join(", ")}.`);
    if (soft.length > 0) parts.push(`Soft, but usable: ${soft.join(", ")}.`);
    return parts.join(" ");
  }

  #order(): void {
    const next = this.#kept.filter(({ name }) => !this.#setAside.has(name));
    if (this.#ordered.length === 0 && next.length > 0) {
      this.#ordered = next.map(({ name }) => name);
      this.#improver.order(next);
    }
    this.onChange();
  }
}
