import { EASINGS, Timeline, type Easing, type Key } from "./timeline.ts";

/** States of a kind of model: between two of them, and as JSON. */
export interface States<State> {
  readonly kind: "posing" | "interpolation";
  between(from: State, to: State, share: number): State;
  /** The entries of a key in a file. */
  written(state: State): Record<string, unknown>;
  /** A state from a key's entries, after the state of the key before; throws an Error that says what is wrong. */
  read(entry: Record<string, unknown>, before: State | null): State;
}

const [FORMAT, VERSION] = ["snapspace-timeline", 1];

/** A timeline as JSON, as snapspace/timeline/timeline_file.py reads it. */
export function timelineFile<State>({ keys, loop }: Timeline<State>, states: States<State>): string {
  const entries = keys.map(({ time, easing, state }) => ({ time, easing, ...states.written(state) }));
  const content = { format: FORMAT, version: VERSION, kind: states.kind, loop, keys: entries };
  return `${JSON.stringify(content, null, 1)}\n`;
}

/** The timeline of a file; throws an Error with a text for the user. */
export function readTimeline<State>(text: string, states: States<State>): Timeline<State> {
  return timelineOf(parsed(text), states);
}

/** The timeline of a model that had other handles: keys drop those that are not among `handles`. */
export function continuedTimeline<State>(
  text: string,
  states: States<State>,
  handles: readonly string[],
): { timeline: Timeline<State>; lost: string[] } {
  const content = parsed(text) as { keys: { handles?: Record<string, unknown> }[] };
  const lost = new Set<string>();
  for (const { handles: moved = {} } of content.keys)
    for (const name of Object.keys(moved).filter((name) => !handles.includes(name))) {
      lost.add(name);
      delete moved[name];
    }
  return { timeline: timelineOf(content, states), lost: [...lost] };
}

/** The timeline of parsed JSON; throws an Error with a text for the user. */
export function timelineOf<State>(given: unknown, states: States<State>): Timeline<State> {
  if (typeof given !== "object" || given === null) throw new Error("This file is not a timeline.");
  const content = given as Record<string, unknown>;
  if (content["format"] !== FORMAT || content["version"] !== VERSION)
    throw new Error("This file is not a timeline of this version of Snapspace.");
  if (content["kind"] !== states.kind)
    throw new Error(`The timeline is of kind ${String(content["kind"])}, but the model of ${states.kind}.`);
  const entries = content["keys"];
  if (!Array.isArray(entries) || entries.length === 0) throw new Error("The timeline has no keys.");
  const keys: Key<State>[] = [];
  for (const [number, entry] of entries.entries()) {
    if (typeof entry !== "object" || entry === null)
      throw new Error(`Key ${number} of the timeline is not an object.`);
    const { time, easing = "smooth" } = entry as Record<string, unknown>;
    if (typeof time !== "number" || !(time >= 0) || time <= (keys.at(-1)?.time ?? -1))
      throw new Error(`Key ${number} of the timeline has no time after the one before it.`);
    if (!EASINGS.includes(easing as Easing))
      throw new Error(`Key ${number} of the timeline has an unknown easing.`);
    const state = states.read(entry as Record<string, unknown>, keys.at(-1)?.state ?? null);
    keys.push({ time, easing: easing as Easing, state });
  }
  return new Timeline(keys, content["loop"] === true);
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    throw new Error("This file is not JSON.");
  }
}
