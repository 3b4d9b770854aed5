import type { Container } from "./container.ts";

type Axis = "x" | "y" | "z";

/** The record of a model file (`provenance`): what made the model, and how it is shown. It may hold anything. */
export function readRecord(container: Container): Record<string, unknown> {
  try {
    const record: unknown = JSON.parse(container.header["provenance"] ?? "{}");
    return typeof record === "object" && record !== null ? (record as Record<string, unknown>) : {};
  } catch {
    return {};
  }
}

/** The axis that points up; if the record has none, the one that is usual for the surface's file (as `SurfaceFile.up`). */
export function upOf({ up }: Record<string, unknown>, file: unknown): { up?: Axis } {
  if (up === "x" || up === "y" || up === "z") return { up };
  return typeof file === "string" && /\.(obj|glb|gltf)$/i.test(file) ? { up: "y" } : {};
}

/** The timeline that was saved with the model; undefined if the record has none. */
export function timelineOf({ timeline }: Record<string, unknown>): { timeline?: unknown } {
  return timeline === undefined ? {} : { timeline };
}

/** The handle of each surface vertex as it was painted, -1 for none; null unless the record has all handles. */
export function paintedOwners(
  { painted }: Record<string, unknown>,
  names: readonly string[],
  vertices: number,
): Int32Array<ArrayBuffer> | null {
  if (typeof painted !== "object" || painted === null) return null;
  const owners = new Int32Array(vertices).fill(-1);
  for (const [handle, name] of names.entries()) {
    const own = Object.hasOwn(painted, name) ? (painted as Record<string, unknown>)[name] : null;
    if (!Array.isArray(own)) return null;
    if (!own.every((vertex) => Number.isInteger(vertex) && 0 <= vertex && vertex < vertices)) return null;
    own.forEach((vertex: number) => (owners[vertex] = handle));
  }
  return owners;
}
