import { Quaternion, Vector3 } from "three";

import type { Motion } from "../engine/index.ts";
import { quaternionOf, rotationOf } from "./rotations.ts";

/** Degrees of a step, and the share of the diagonal that a step of length has at most. */
const [DEGREES, SHARE] = [5, 1 / 40];

/** Rounds drags: lengths along the axes to multiples of a step, turns to multiples of five degrees. */
export class Snapping {
  isOn = false;
  /** The step of lengths in the mesh's unit: 1, 2 or 5 times a power of ten. */
  readonly length: number;
  readonly degrees = DEGREES;

  constructor(diagonal: number) {
    this.length = roundStep(SHARE * diagonal);
  }

  /** A motion that a drag from `start` asks for. Along a handle's own axes the way from the start is rounded, else the
   * place. Directions that it is not dragged in keep their place. The same motion while snapping is off. */
  rounded(start: Motion, asked: Motion, isLocal: boolean): Motion {
    if (!this.isOn) return asked;
    return {
      rotation: this.#turned(start, asked),
      translation: isLocal ? this.#alongOwnAxes(start, asked) : this.#alongAxes(start, asked),
    };
  }

  #turned(start: Motion, asked: Motion): Motion["rotation"] {
    const before = quaternionOf(start.rotation);
    const turn = quaternionOf(asked.rotation).multiply(before.clone().invert());
    if (turn.w < 0) turn.set(-turn.x, -turn.y, -turn.z, -turn.w);
    const axis = new Vector3(turn.x, turn.y, turn.z);
    const size = axis.length();
    if (size < 1e-9) return start.rotation;
    const step = (DEGREES * Math.PI) / 180;
    const angle = step * Math.round((2 * Math.atan2(size, turn.w)) / step);
    return rotationOf(new Quaternion().setFromAxisAngle(axis.divideScalar(size), angle).multiply(before));
  }

  #alongOwnAxes(start: Motion, asked: Motion): Motion["translation"] {
    const own = quaternionOf(start.rotation);
    const from = new Vector3(...start.translation);
    const way = new Vector3(...asked.translation).sub(from).applyQuaternion(own.clone().invert());
    const rounded = new Vector3(this.#round(way.x), this.#round(way.y), this.#round(way.z));
    const { x, y, z } = rounded.applyQuaternion(own).add(from);
    return [x, y, z];
  }

  #alongAxes({ translation: start }: Motion, { translation: asked }: Motion): Motion["translation"] {
    const isDragged = (axis: number) => Math.abs(asked[axis] - start[axis]) > 1e-6 * this.length;
    const place = (axis: number) => (isDragged(axis) ? this.#round(asked[axis]) : start[axis]);
    return [place(0), place(1), place(2)];
  }

  #round(length: number): number {
    return this.length * Math.round(length / this.length);
  }
}

/** The largest of 1, 2 and 5 times a power of ten that is not above a length. */
export function roundStep(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  const factor = [5, 2, 1].find((one) => one * power <= length * (1 + 1e-9)) ?? 1;
  return Number((factor * power).toPrecision(1));
}
