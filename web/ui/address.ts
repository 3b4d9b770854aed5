import { eulerOfRotation, rotationOfEuler, type Vector } from "../engine/motion.ts";
import type { Motions, ViewState } from "./view.ts";

/** What the page's address keeps, so that a reload finds the same state: the workspace in the query,
 * and in the hash the pose, the weights of a blend, or that handles are being chosen. Keys are beside it. */

export const CHOOSING = "#choose";
const [POSE, BLEND] = ["#pose=", "#blend="];
const DIGITS = 6;
// Milliseconds: browsers refuse an address that changes with every picture, and take it again after some seconds.
const [PAUSE, LATER] = [250, 3000];

/** Handles with Euler angles in radians and translations; empty at rest. */
export function poseHash(motions: Motions): string {
  const entries = [...motions].map(([name, { rotation, translation }]) => {
    const numbers = [...eulerOfRotation(rotation), ...translation].map(short);
    return [name, numbers] as const;
  });
  if (entries.every(([, numbers]) => numbers.every((number) => number === 0))) return "";
  return POSE + entries.map(([name, numbers]) => `${escaped(name)}:${numbers.join(",")}`).join(";");
}

/** The motions in a hash; none if it holds no pose, or a damaged one. */
export function motionsOf(hash: string): Motions {
  const found = entriesOf(hash, POSE).map(([name, [a, b, c, x, y, z, ...more]]) => {
    const isWhole = z !== undefined && more.length === 0;
    const euler: Vector = [a, b, c];
    const translation: Vector = [x, y, z];
    return isWhole ? ([name, { rotation: rotationOfEuler(euler), translation }] as const) : null;
  });
  return found.every((entry) => entry !== null) ? new Map(found) : new Map();
}

/** Poses that take part, with their weights, in order. */
export function blendHash({ names, weights }: NonNullable<ViewState["blend"]>): string {
  return BLEND + names.map((name, i) => `${escaped(name)}:${short(weights[i])}`).join(";");
}

/** Names and weights in a hash; none if it holds no blend, or a damaged one. */
export function blendOf(hash: string): { names: string[]; weights: number[] } {
  const entries = entriesOf(hash, BLEND);
  const isWhole = entries.every(([, numbers]) => numbers.length === 1);
  const taken = isWhole ? entries : [];
  return { names: taken.map(([name]) => name), weights: taken.map(([, [weight]]) => weight) };
}

/** The state that a hash describes, for a view to begin with. */
export function stateOf(hash: string): ViewState {
  return { motions: motionsOf(hash), blend: blendOf(hash) };
}

function entriesOf(hash: string, kind: string): [string, number[]][] {
  if (!hash.startsWith(kind)) return [];
  try {
    const entries = hash
      .slice(kind.length)
      .split(";")
      .map((entry): [string, number[]] => {
        const [name, numbers = ""] = entry.split(":");
        return [decodeURIComponent(name), numbers.split(",").map((n) => (n ? Number(n) : NaN))];
      });
    return entries.every(([, numbers]) => numbers.every(Number.isFinite)) ? entries : [];
  } catch {
    return []; // a damaged escape
  }
}

const short = (value: number) => Number(value.toPrecision(DIGITS)) || 0;
const escaped = (name: string) =>
  encodeURIComponent(name).replace(/[!'()*]/g, (c) => `%${c.charCodeAt(0).toString(16)}`);

let waiting: { hash: () => string; timer: number } | null = null;

/** Writes a hash soon, for what changes many times a second; `hash` is asked for it then. */
export function keepHashSoon(hash: () => string, pause = PAUSE): void {
  if (waiting) clearTimeout(waiting.timer);
  waiting = { hash, timer: window.setTimeout(writeHash, pause) };
}

/** Writes a hash at once: a page that is reloading can no longer change its address. */
export function keepHash(hash: () => string): void {
  keepHashSoon(hash);
  writeHash();
}

/** The address of what is shown now. */
export function currentAddress(): string {
  writeHash();
  return location.href;
}

function writeHash(): void {
  if (!waiting) return;
  const { hash, timer } = waiting;
  waiting = null;
  clearTimeout(timer);
  const url = new URL(location.href);
  url.hash = hash();
  if (!write(url)) keepHashSoon(hash, LATER);
}

export function keepQuery(name: string, value: string): void {
  const url = new URL(location.href);
  if (url.searchParams.get(name) === value) return;
  url.searchParams.set(name, value);
  write(url);
}

/** The keys of a timeline, for models of this kind and name; null if there are none. */
export class KeptKeys {
  readonly #kind: string;

  constructor(kind: string) {
    this.#kind = kind;
  }

  get keys(): string | null {
    const kept = history.state as { kind?: unknown; keys?: unknown } | null;
    return kept?.kind === this.#kind && typeof kept.keys === "string" ? kept.keys : null;
  }

  set keys(keys: string | null) {
    if (keys !== this.keys) write(new URL(location.href), keys === null ? null : { kind: this.#kind, keys });
  }
}

/** Writes the address, and what is kept beside it; false if it should be tried again later. */
function write(url: URL, beside: unknown = history.state): boolean {
  const isSame = url.href === location.href && beside === history.state;
  if (isSame || location.protocol === "about:") return true; // frames of notebooks have no address
  try {
    history.replaceState(beside, "", url);
  } catch {
    return false; // too often for this browser
  }
  return true;
}
