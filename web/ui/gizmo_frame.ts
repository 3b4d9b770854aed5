import { Vector3, type Quaternion } from "three";

import { allInWindow, rayAt } from "./canvas_ray.ts";
import { ARROW, BEHIND, RING, SQUARE, VIEW_RING, type GizmoPart } from "./gizmo_parts.ts";
import type { Stage } from "./stage.ts";

/** How far the pointer may be from an arrow or ring, in pixels. */
const REACH = { mouse: 7, touch: 16 };
/** The dot in the middle is the handle itself, which is dragged freely: its radius on the stage, and the largest share of
 * the gizmo that is left to it. */
const [DOT, MOST_OF_GIZMO] = [0.017, 0.2];
/** Arrows that point at the camera, and squares that are seen from their edges, cannot be dragged. */
const [MOST_ALONG, LEAST_ACROSS] = [0.97, 0.2];
/** Points of a ring that are looked at. */
const POINTS = 96;

type Pixel = readonly [number, number];

/** Where the gizmo is on the stage, and what of it is below a point of the window. */
export class GizmoFrame {
  readonly stage: Stage;
  readonly middle: Vector3;
  /** Unit vectors along the arrows. */
  readonly axes: readonly [Vector3, Vector3, Vector3];
  /** From the middle to the camera. */
  readonly toCamera: Vector3;
  readonly size: number;

  constructor(stage: Stage, middle: Vector3, turned: Quaternion, size: number) {
    [this.stage, this.middle, this.size] = [stage, middle, size];
    const unit = (x: number, y: number, z: number) => new Vector3(x, y, z).applyQuaternion(turned);
    this.axes = [unit(1, 0, 0), unit(0, 1, 0), unit(0, 0, 1)];
    this.toCamera = stage.camera.getWorldPosition(new Vector3()).sub(middle).normalize();
  }

  /** Whether a part is seen from where it can be dragged. */
  isUsable({ kind, axis }: GizmoPart): boolean {
    if (axis < 0 || kind === "ring") return true;
    const along = Math.abs(this.axes[axis].dot(this.toCamera));
    return kind === "arrow" ? along < MOST_ALONG : along > LEAST_ACROSS;
  }

  /** The part at a point of the window: a square, or the nearest arrow or ring. */
  partAt(parts: readonly GizmoPart[], x: number, y: number, isTouch: boolean): GizmoPart | null {
    const { direction, origin } = rayAt(this.stage, x, y);
    const away = origin.clone().sub(this.middle).cross(direction).length();
    if (away < Math.min(DOT, MOST_OF_GIZMO * this.size)) return null;
    const usable = parts.filter((part) => part.mesh.visible);
    const inside = usable.findLast(
      (part) => part.kind === "square" && isInside(this.#inWindow(this.#square(part)), x, y),
    );
    if (inside) return inside;
    let [best, nearest]: [GizmoPart | null, number] = [null, isTouch ? REACH.touch : REACH.mouse];
    for (const part of usable) {
      if (part.kind === "square") continue;
      const line = this.#inWindow(part.kind === "arrow" ? this.#arrow(part) : this.ring(part));
      const away = distance(line, x, y);
      if (away < nearest) [best, nearest] = [part, away];
    }
    return best;
  }

  /** Points along the part of a ring that is drawn. */
  ring({ kind, axis }: GizmoPart): Vector3[] {
    const about = kind === "view" ? this.toCamera : this.axes[axis];
    const front = this.toCamera.clone().addScaledVector(about, -about.dot(this.toCamera));
    const seen = kind === "view" || front.length() <= BEHIND ? Math.PI : Math.acos(-BEHIND / front.length());
    if (front.length() < 1e-3) front.copy(acrossOf(about));
    const radius = (kind === "view" ? VIEW_RING : RING) * this.size;
    front.setLength(radius);
    return Array.from({ length: POINTS + 1 }, (_, i) =>
      front
        .clone()
        .applyAxisAngle(about, seen * ((2 * i) / POINTS - 1))
        .add(this.middle),
    );
  }

  /** The point of a ring that is nearest to a point of the window. */
  nearestOn(part: GizmoPart, x: number, y: number): Vector3 {
    const points = this.ring(part);
    const away = this.#inWindow(points).map(([px, py]) => Math.hypot(px - x, py - y));
    return points[away.indexOf(Math.min(...away))];
  }

  #arrow({ axis }: GizmoPart): Vector3[] {
    return ARROW.map((share) => this.#along(axis, share));
  }

  #square({ axis }: GizmoPart): Vector3[] {
    const [from, to] = SQUARE;
    const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    return (
      [
        [from, from],
        [to, from],
        [to, to],
        [from, to],
      ] as const
    ).map(([a, b]) => this.#along(u, a).addScaledVector(this.axes[v], b * this.size));
  }

  #along(axis: number, share: number): Vector3 {
    return this.middle.clone().addScaledVector(this.axes[axis], share * this.size);
  }

  #inWindow(places: readonly Vector3[]): Pixel[] {
    return allInWindow(this.stage, places);
  }
}

/** Any vector across a unit vector. */
function acrossOf({ x, y, z }: Vector3): Vector3 {
  const isAlongX = Math.abs(x) > 0.7;
  return new Vector3(isAlongX ? 0 : 1, isAlongX ? 1 : 0, 0).cross(new Vector3(x, y, z));
}

/** From a point to a line through pixels. */
function distance(line: readonly Pixel[], x: number, y: number): number {
  const away = line.slice(1).map(([bx, by], i) => {
    const [ax, ay] = line[i];
    const square = (bx - ax) ** 2 + (by - ay) ** 2;
    const share = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / (square || 1);
    const at = Math.min(Math.max(share, 0), 1);
    return Math.hypot(ax + at * (bx - ax) - x, ay + at * (by - ay) - y);
  });
  return Math.min(...away);
}

function isInside(corners: readonly Pixel[], x: number, y: number): boolean {
  const sides = corners.map(([ax, ay], i) => {
    const [bx, by] = corners[(i + 1) % corners.length];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax);
  });
  return sides.every((side) => side > 0) || sides.every((side) => side < 0);
}
