import { Plane, Quaternion, Vector3, type Ray } from "three";

import type { Motion } from "../engine/index.ts";
import { inWindow, rayAt } from "./canvas_ray.ts";
import type { GizmoFrame } from "./gizmo_frame.ts";
import type { GizmoPart } from "./gizmo_parts.ts";
import { quaternionOf, rotationOf } from "./rotations.ts";

/** Pixels per radian that a ring is taken to move at least: where it runs towards the camera it seems to stand still. */
const LEAST_PIXELS = 30;
/** The pointer is followed in the plane of a ring whose axis has at least this cosine with the view. */
const LEAST_ACROSS = 0.3;
/** How far arrows and squares are dragged at most, in diagonals: near the horizon the pointer is infinitely far. */
const FARTHEST = 3;

/** The motion that a handle is asked for while the pointer is at a point of the window. */
export type Drag = (x: number, y: number) => Motion;

/** A drag of a part of the gizmo, from a point of the window and a motion. */
export function dragOf(frame: GizmoFrame, part: GizmoPart, start: Motion, x: number, y: number): Drag {
  if (part.kind === "arrow") return alongAxis(frame, frame.axes[part.axis], start, x, y);
  if (part.kind === "square") return acrossAxis(frame, frame.axes[part.axis], start, x, y);
  if (part.kind === "ring") return aboutAxis(frame, part, start, x, y);
  return aboutView(frame, start, x, y);
}

function alongAxis(frame: GizmoFrame, axis: Vector3, start: Motion, x: number, y: number): Drag {
  const place = (x: number, y: number) => nearestOnAxis(rayAt(frame.stage, x, y), frame.middle, axis);
  const from = place(x, y);
  return (x, y) => {
    const way = Math.min(Math.max(place(x, y) - from, -FARTHEST), FARTHEST);
    return shifted(frame, start, axis.clone().multiplyScalar(way));
  };
}

function acrossAxis(frame: GizmoFrame, axis: Vector3, start: Motion, x: number, y: number): Drag {
  const place = inPlane(frame, axis);
  const from = place(x, y)!;
  let way = new Vector3();
  return (x, y) => {
    way = place(x, y)?.sub(from).clampLength(0, FARTHEST) ?? way;
    return shifted(frame, start, way.clone());
  };
}

function aboutAxis(frame: GizmoFrame, part: GizmoPart, start: Motion, x: number, y: number): Drag {
  const axis = frame.axes[part.axis];
  return Math.abs(axis.dot(frame.toCamera)) >= LEAST_ACROSS
    ? aroundAxis(frame, axis, start, x, y)
    : alongRing(frame, part, axis, start, x, y);
}

/** The angle of the pointer about the axis, in the plane of the ring. */
function aroundAxis(frame: GizmoFrame, axis: Vector3, start: Motion, x: number, y: number): Drag {
  const place = inPlane(frame, axis);
  const from = place(x, y)!.sub(frame.middle);
  let angle = 0;
  return (x, y) => {
    const to = place(x, y)?.sub(frame.middle);
    if (to) angle = Math.atan2(from.clone().cross(to).dot(axis), from.dot(to));
    return turned(frame, start, axis, angle);
  };
}

/** The way of the pointer along a ring that is seen from its edge, where it was taken hold of. */
function alongRing(
  frame: GizmoFrame,
  part: GizmoPart,
  axis: Vector3,
  start: Motion,
  x: number,
  y: number,
): Drag {
  const held = frame.nearestOn(part, x, y);
  const [hx, hy] = inWindow(frame.stage, held);
  const step = 1e-3;
  const further = held.clone().sub(frame.middle).applyAxisAngle(axis, step).add(frame.middle);
  const [fx, fy] = inWindow(frame.stage, further);
  const [tx, ty] = [(fx - hx) / step, (fy - hy) / step];
  const square = Math.max(tx * tx + ty * ty, LEAST_PIXELS ** 2);
  return (nx, ny) => turned(frame, start, axis, ((nx - x) * tx + (ny - y) * ty) / square);
}

/** The angle of the pointer about the middle. */
function aboutView(frame: GizmoFrame, start: Motion, x: number, y: number): Drag {
  const [mx, my] = inWindow(frame.stage, frame.middle);
  const angle = (x: number, y: number) => Math.atan2(my - y, x - mx);
  const from = angle(x, y);
  return (x, y) => turned(frame, start, frame.toCamera, angle(x, y) - from);
}

/** The point below the pointer in the plane across an axis through the middle; null past the horizon. */
function inPlane({ stage, middle }: GizmoFrame, axis: Vector3): (x: number, y: number) => Vector3 | null {
  const plane = new Plane().setFromNormalAndCoplanarPoint(axis, middle);
  return (x, y) => rayAt(stage, x, y).intersectPlane(plane, new Vector3());
}

/** Where on an axis the point is that is nearest to a ray, as a length from the middle. */
function nearestOnAxis({ origin, direction }: Ray, middle: Vector3, axis: Vector3): number {
  const away = origin.clone().sub(middle);
  const cosine = axis.dot(direction);
  return (axis.dot(away) - cosine * direction.dot(away)) / (1 - cosine * cosine);
}

function shifted({ stage }: GizmoFrame, start: Motion, way: Vector3): Motion {
  const { root } = stage;
  const own = way.applyQuaternion(root.quaternion.clone().invert()).divideScalar(root.scale.x);
  const [x, y, z] = start.translation;
  return { rotation: start.rotation, translation: [x + own.x, y + own.y, z + own.z] };
}

function turned({ stage }: GizmoFrame, start: Motion, axis: Vector3, angle: number): Motion {
  const own = axis.clone().applyQuaternion(stage.root.quaternion.clone().invert());
  const turn = new Quaternion().setFromAxisAngle(own, angle).multiply(quaternionOf(start.rotation));
  return { rotation: rotationOf(turn), translation: start.translation };
}
