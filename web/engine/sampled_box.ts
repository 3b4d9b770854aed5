import { eulerOfRotation, type Rotation, type Vector } from "./motion.ts";

/** Half widths of the box of a handle's motions that a model was sampled in: lengths, and radians. */
export interface Box {
  readonly translation: readonly number[];
  readonly angle: readonly number[];
}

const ROUNDING = 1e-9;

/** The box of each handle, from common bounds of all moving ones or from a row of bounds for each. */
export function boxesOf(
  domain: { translation: number[] | number[][]; angle: number[] | number[][] },
  handles: number,
): Box[] {
  const row = (bounds: number[] | number[][], moving: number) =>
    Array.isArray(bounds[0]) ? (bounds as number[][])[moving] : (bounds as number[]);
  const rest: Box = { translation: [0, 0, 0], angle: [0, 0, 0] };
  const moving = Array.from({ length: handles - 1 }, (_, i) => ({
    translation: row(domain.translation, i),
    angle: row(domain.angle, i),
  }));
  return [rest, ...moving];
}

/** How a motion about a handle's centroid leaves the box, for a reader; null inside.
 *
 * A rotation has two triples of Euler angles (besides turns by 2 pi); one of them in the box is enough. */
export function beyondBox(box: Box, rotation: Rotation, translation: Vector): string | null {
  for (let axis = 0; axis < 3; axis++)
    if (Math.abs(translation[axis]) > box.translation[axis] + ROUNDING)
      return `${"xyz"[axis]} ${signed(translation[axis])} of ±${short(box.translation[axis])}`;
  const angles = eulerOfRotation(rotation);
  const [alpha, beta, gamma] = angles;
  const other: Vector = [wrapped(alpha + Math.PI), wrapped(Math.PI - beta), wrapped(gamma + Math.PI)];
  const outside = (triple: Vector) =>
    triple.findIndex((angle, i) => Math.abs(angle) > box.angle[i] + ROUNDING);
  if (outside(angles) < 0 || outside(other) < 0) return null;
  const axis = outside(angles);
  const degrees = (angle: number) => Math.round((180 * angle) / Math.PI);
  return `turn about ${"xyz"[axis]} ${degrees(angles[axis])}° of ±${degrees(box.angle[axis])}°`;
}

function wrapped(angle: number): number {
  const turn = 2 * Math.PI;
  return ((((angle + Math.PI) % turn) + turn) % turn) - Math.PI;
}

const short = (length: number) => String(Number(length.toPrecision(3)));
const signed = (length: number) => (length > 0 ? "+" : "−") + short(Math.abs(length));
