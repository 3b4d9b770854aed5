import { Color } from "three";

import { inOrder, type Choice, type ChosenHandle } from "../engine/choice.ts";
import type { ChosenPart } from "../engine/parts.ts";
import { CLAY, handleColor, partColor } from "./handle_colors.ts";

const SELECTED = new Color("#14b8ff");
const MOST = 254; // handles and parts; a byte also holds "none" and the selection

/** The colour of a handle, the same that it will have in a model. */
export function colorOf(handles: readonly ChosenHandle[], key: number): string {
  return handleColor(inOrder(handles).findIndex((handle) => handle.key === key));
}

export function partColorOf(parts: readonly ChosenPart[], key: number): string {
  return partColor(parts.findIndex((part) => part.key === key));
}

/** Writes the owner of every vertex, as an index of the returned colours. Handles cover parts. */
export function ownerColors({ handles, parts }: Choice, owners: Uint8Array, selected: Int32Array): Color[] {
  const shown = [
    ...parts.map(({ vertices }, i) => [vertices, partColor(i)] as const),
    ...inOrder(handles).map(({ vertices }, i) => [vertices, handleColor(i)] as const),
  ].slice(0, MOST);
  owners.fill(0);
  shown.forEach(([vertices], i) => vertices.forEach((vertex) => (owners[vertex] = i + 1)));
  selected.forEach((vertex) => (owners[vertex] = MOST + 1));
  const colors = [CLAY, ...shown.map(([, color]) => new Color(color))];
  colors[MOST + 1] = SELECTED;
  return colors;
}
