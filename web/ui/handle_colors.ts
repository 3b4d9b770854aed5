import { Color } from "three";

/** The handle that was fixed while sampling is slate; the others take these in turn. */
const MOVING = ["#e2593f", "#1f9e8f", "#e0a02c", "#7d63cf", "#3d85d1", "#c7528f"];

export function handleColor(handle: number): string {
  return handle === 0 ? "#66758c" : MOVING[(handle - 1) % MOVING.length];
}

export const CLAY = new Color("#d8cbb6");
