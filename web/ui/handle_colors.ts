import { Color } from "three";

/** The handle that was fixed while sampling is slate; the others take these in turn. */
const MOVING = ["#e2593f", "#1f9e8f", "#e0a02c", "#7d63cf", "#3d85d1", "#c7528f"];

export function handleColor(handle: number): string {
  return handle === 0 ? "#66758c" : MOVING[(handle - 1) % MOVING.length];
}

/** Parts take these in turn: muted, unlike handles. */
const PARTS = ["#7c8a3c", "#9a6a4a", "#4f7a63", "#8d6f8f", "#b08a6a"];

export function partColor(part: number): string {
  return PARTS[part % PARTS.length];
}

export const CLAY = new Color("#d8cbb6");
