import { Color } from "three";

import { inOrder, type ChosenHandle } from "../engine/choice.ts";
import { CLAY, handleColor } from "./handle_colors.ts";

const SELECTED = new Color("#14b8ff");
const MOST = 254; // handles, next to nothing and the selection in a byte

/** The colour of a handle here is that which it will have in a model. */
export function colorOf(handles: readonly ChosenHandle[], key: number): string {
  return handleColor(inOrder(handles).findIndex((handle) => handle.key === key));
}

/** Writes for every vertex whose it is, as a number of the colours that are returned. */
export function ownerColors(
  handles: readonly ChosenHandle[],
  owners: Uint8Array,
  selected: Int32Array,
): Color[] {
  const shown = inOrder(handles).slice(0, MOST);
  owners.fill(0);
  shown.forEach(({ vertices }, i) => vertices.forEach((vertex) => (owners[vertex] = i + 1)));
  selected.forEach((vertex) => (owners[vertex] = MOST + 1));
  const colors = [CLAY, ...shown.map((_, i) => new Color(handleColor(i)))];
  colors[MOST + 1] = SELECTED;
  return colors;
}
