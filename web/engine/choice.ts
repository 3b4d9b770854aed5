import type { HandleChoice, PartChoice, Vector } from "./messages.ts";
import type { ChosenPart } from "./parts.ts";
import { NOTHING, union, without } from "./selecting.ts";

/** Half widths of the sampled motions per axis; null for the common ones. */
export interface Ranges {
  readonly translation: Vector | null;
  readonly angle: Vector | null;
}

export interface ChosenHandle extends Ranges {
  /** Stays the same when the name changes. */
  readonly key: number;
  readonly name: string;
  /** Ascending. */
  readonly vertices: Int32Array;
  readonly moving: boolean;
}

/** Vertices that are selected, handles and parts so far. Never changed: every step makes a new one. */
export interface Choice {
  /** Ascending. */
  readonly selected: Int32Array;
  readonly handles: readonly ChosenHandle[];
  readonly parts: readonly ChosenPart[];
}

/** The choice of a server or a problem file. */
export function choiceOf(handles: readonly HandleChoice[], parts: readonly PartChoice[] = []): Choice {
  const chosen = handles.map(({ name, vertices, moving = true, translation = null, angle = null }, key) => ({
    key,
    name,
    vertices: Int32Array.from(vertices).sort(),
    moving,
    translation,
    angle,
  }));
  const shown = parts.map(({ name, vertices, factor }, key) => ({
    key,
    name,
    vertices: Int32Array.from(vertices).sort(),
    factor,
  }));
  return { selected: NOTHING, handles: chosen, parts: shown };
}

/** The handles in the order of the server and of models: those that hold the shape come first. */
export function inOrder(handles: readonly ChosenHandle[]): ChosenHandle[] {
  return [...handles.filter(({ moving }) => !moving), ...handles.filter(({ moving }) => moving)];
}

/** Messages of the handles in the server's order. */
export function orderedHandleMessages(handles: readonly ChosenHandle[]): HandleChoice[] {
  return handleMessages(inOrder(handles));
}

/** Messages of the handles in the page's own order, which the server keeps for the page. */
export function handleMessages(handles: readonly ChosenHandle[]): HandleChoice[] {
  return handles.map(({ key: _, vertices, ...rest }) => ({ ...rest, vertices: [...vertices] }));
}

/** Makes a handle of the selected vertices. The first handle holds the shape, the others move. */
export function withNewHandle(choice: Choice): Choice {
  const { selected, handles } = choice;
  const key = 1 + Math.max(-1, ...handles.map((handle) => handle.key));
  const others = withoutVertices(handles, selected);
  const moving = others.some((handle) => !handle.moving);
  const name = freeName(handles);
  const own = { key, name, vertices: selected, moving, translation: null, angle: null };
  return { ...choice, selected: NOTHING, handles: [...others, own] };
}

/** Adds handles that a server made of kept points, unless the choice has them. */
export function withKept(choice: Choice, kept: readonly HandleChoice[]): Choice {
  const names = new Set(choice.handles.map(({ name }) => name));
  const next = 1 + Math.max(-1, ...choice.handles.map(({ key }) => key));
  const more = choiceOf(kept.filter(({ name }) => !names.has(name))).handles;
  return { ...choice, handles: [...choice.handles, ...more.map((own) => ({ ...own, key: next + own.key }))] };
}

/** Adds the selected vertices to a handle. */
export function withMore(choice: Choice, key: number): Choice {
  const { selected, handles } = choice;
  const owner = handles.find((handle) => handle.key === key)!;
  const others = withoutVertices(
    handles.filter((handle) => handle !== owner),
    selected,
  );
  const grown = { ...owner, vertices: union(owner.vertices, selected) };
  const left = handles.flatMap((handle) =>
    handle === owner ? [grown] : others.filter((other) => other.key === handle.key),
  );
  return { ...choice, selected: NOTHING, handles: left };
}

/** Adds the mirror image of a handle, or puts it in place of the handle that has its name. Other handles lose the image's
 * vertices, except the mirrored one. Null if nothing is left of the image. */
export function withMirrored(choice: Choice, key: number, image: HandleChoice): Choice | null {
  const [made] = choiceOf([image]).handles;
  const source = choice.handles.find((handle) => handle.key === key);
  const vertices = without(made.vertices, source?.vertices ?? NOTHING);
  if (vertices.length === 0) return null;
  const before = choice.handles.find(({ name }) => name === image.name);
  const free = 1 + Math.max(-1, ...choice.handles.map((handle) => handle.key));
  const own = { ...made, vertices, key: before?.key ?? free };
  const kept = withoutVertices(
    choice.handles.filter((handle) => handle !== before),
    vertices,
  );
  if (!before) return { ...choice, handles: [...kept, own] };
  const handles = choice.handles.flatMap((handle) =>
    handle === before ? [own] : kept.filter((other) => other.key === handle.key),
  );
  return { ...choice, handles };
}

/** Removes the selected vertices from all handles. */
export function withFree(choice: Choice): Choice {
  return { ...choice, handles: withoutVertices(choice.handles, choice.selected) };
}

export function changed(choice: Choice, key: number, fields: Partial<ChosenHandle>): Choice {
  const handles = choice.handles.map((handle) => (handle.key === key ? { ...handle, ...fields } : handle));
  return { ...choice, handles };
}

export function withoutHandle(choice: Choice, key: number): Choice {
  return { ...choice, handles: choice.handles.filter((handle) => handle.key !== key) };
}

/** What handles lost from one choice to the next, for the user; empty if nothing. */
export function losses(before: Choice, after: Choice): string {
  const lost = before.handles.flatMap(({ key, name, vertices }) => {
    const left = after.handles.find((handle) => handle.key === key)?.vertices.length ?? 0;
    const count = vertices.length - left;
    if (count <= 0) return [];
    if (left === 0) return [`all of ${name}, which is removed`];
    return [`${count.toLocaleString("en")} of ${name}`];
  });
  return lost.length ? `Taken from other handles: ${lost.join("; ")}.` : "";
}

/** Why a name cannot be given to a handle; empty if it can. */
export function nameFault(choice: Choice, key: number, name: string): string {
  if (name.trim() === "") return "A handle needs a name.";
  const taken = choice.handles.some((handle) => handle.key !== key && handle.name === name.trim());
  return taken ? `There is already a handle named ${name.trim()}.` : "";
}

/** What must still be chosen before a model can be computed; empty if nothing. */
export function lacking({ handles }: Choice): string {
  if (handles.length === 0) return "First select the part that stays in place, and make it a handle.";
  if (handles.length === 1) return "Now select a part to move, and make it a handle.";
  if (handles.every(({ moving }) => moving)) return "One handle must be fixed: it holds the shape.";
  if (handles.every(({ moving }) => !moving)) return "One handle must move.";
  return "";
}

function withoutVertices(handles: readonly ChosenHandle[], vertices: Int32Array): ChosenHandle[] {
  return handles
    .map((handle) => {
      const left = without(handle.vertices, vertices);
      return left.length === handle.vertices.length ? handle : { ...handle, vertices: left };
    })
    .filter((handle) => handle.vertices.length > 0);
}

function freeName(handles: readonly ChosenHandle[]): string {
  const names = new Set(handles.map(({ name }) => name));
  let number = handles.length + 1;
  while (names.has(`handle ${number}`)) number++;
  return `handle ${number}`;
}
