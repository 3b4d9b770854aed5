import { Matrix4, Plane, Quaternion, Vector3 } from "three";

import type { Motion } from "../engine/index.ts";
import { LEAST_WAY, listenToPointers } from "./canvas_pointers.ts";
import { inWindow, rayAt } from "./canvas_ray.ts";
import type { Gizmo } from "./posing_gizmo.ts";
import type { Posing } from "./posing.ts";

const MARKER_PIXELS = 18;
const RADIANS_PER_PIXEL = 0.008;
const WARMING = 12; // looks

interface Drag {
  pointer: number;
  handle: number;
  turn: boolean;
  start: Motion;
  x: number;
  y: number;
  plane: Plane;
  grabbed: Vector3;
  moved: boolean;
}

/** Handles are grabbed on the surface, or by their markers, and dragged in the plane of the view; with Shift, or in
 * the turning mode, they are turned about their centres. Works with mouse, pen and touch. */
export class HandleDrag {
  readonly #posing: Posing;
  readonly #gizmo: Gizmo;
  readonly #canvas: HTMLCanvasElement;
  #drag: Drag | null = null;

  constructor(posing: Posing, gizmo: Gizmo, signal: AbortSignal) {
    this.#posing = posing;
    this.#gizmo = gizmo;
    this.#canvas = posing.stage.renderer.canvas;
    const up = (event: PointerEvent) => this.#up(event);
    const acts = { down: this.#down.bind(this), move: this.#move.bind(this), up, cancel: up };
    listenToPointers(this.#canvas, acts, signal);
  }

  /** Searches for handles a few times, as if they had moved: the browser makes fast code of what has run often. */
  warmUp(): void {
    const { session, surface } = this.#posing;
    for (let time = 0; time < WARMING; time++) {
      surface.forgetPicks();
      this.find(...this.screen(time % session.model.handles.length));
    }
  }

  /** The handle below a point of the window, or -1, and where it was hit. */
  find(x: number, y: number): { handle: number; point: Vector3 } {
    const { session, surface, stage } = this.#posing;
    const toShape = surface.object.matrixWorld.clone().invert();
    const hit = surface.pick(rayAt(stage, x, y).applyMatrix4(toShape));
    if (hit) {
      // where any point can be pulled, the nearest corner decides; else all of a handle's triangles belong to it
      const corners = this.#posing.mode === "pull" ? hit.corners.slice(0, 1) : hit.corners;
      const owners = corners.map((vertex) => session.model.handleOfVertex[vertex]);
      const handle = owners.find((owner) => owner >= 0) ?? -1;
      if (handle >= 0)
        return { handle, point: new Vector3(...hit.point).applyMatrix4(surface.object.matrixWorld) };
    }
    let [best, nearest] = [-1, MARKER_PIXELS];
    session.model.handles.forEach((_, handle) => {
      const [px, py] = this.screen(handle);
      const away = Math.hypot(px - x, py - y);
      if (away < nearest) [best, nearest] = [handle, away];
    });
    const place =
      best < 0 ? new Vector3() : new Vector3(...session.place(best)).applyMatrix4(stage.root.matrixWorld);
    return { handle: best, point: place };
  }

  /** The position of a handle's centre in the window. */
  screen(handle: number): [number, number] {
    const { stage, session } = this.#posing;
    const place = new Vector3(...session.place(handle));
    return inWindow(stage, place.applyMatrix4(stage.root.matrixWorld));
  }

  #down(event: PointerEvent): void {
    if (event.target !== this.#canvas || event.button !== 0 || this.#drag) return;
    if (this.#gizmo.isDragging) return;
    const { handle, point } = this.find(event.clientX, event.clientY);
    if (handle < 0) return;
    const { stage } = this.#posing;
    stage.controls.enabled = false;
    this.#canvas.setPointerCapture(event.pointerId);
    const facing = stage.camera.getWorldDirection(new Vector3());
    this.#drag = {
      pointer: event.pointerId,
      handle,
      turn: event.shiftKey || this.#posing.mode === "turn",
      start: this.#posing.motion(handle),
      x: event.clientX,
      y: event.clientY,
      plane: new Plane().setFromNormalAndCoplanarPoint(facing, point),
      grabbed: point,
      moved: false,
    };
    this.#posing.select(handle);
    this.#posing.grab();
  }

  #move(event: PointerEvent): void {
    const drag = this.#drag;
    if (!drag) {
      if (event.pointerType === "mouse" && event.buttons === 0 && event.target === this.#canvas)
        this.#hover(event);
      return;
    }
    if (event.pointerId !== drag.pointer) return;
    const [dx, dy] = [event.clientX - drag.x, event.clientY - drag.y];
    if (!drag.moved && Math.hypot(dx, dy) < LEAST_WAY) return;
    drag.moved = true;
    const asked = drag.turn ? this.#turned(drag, dx, dy) : this.#shifted(drag, event);
    this.#posing.wish(drag.handle, this.#posing.snapped(drag.start, asked));
  }

  #up(event: PointerEvent): void {
    if (event.pointerId !== this.#drag?.pointer) return;
    const { moved } = this.#drag;
    this.#drag = null;
    this.#posing.stage.controls.enabled = true;
    if (moved) this.#posing.commit();
    else this.#posing.release();
  }

  #hover(event: PointerEvent): void {
    const over = this.#gizmo.isActive || this.find(event.clientX, event.clientY).handle >= 0;
    this.#canvas.style.cursor = over ? "grab" : "";
  }

  #shifted(drag: Drag, event: PointerEvent): Motion {
    const { stage } = this.#posing;
    const { root } = stage;
    const target = rayAt(stage, event.clientX, event.clientY).intersectPlane(drag.plane, new Vector3());
    if (!target) return drag.start;
    const [from, to] = [root.worldToLocal(drag.grabbed.clone()), root.worldToLocal(target)];
    const [x, y, z] = to.sub(from).toArray();
    const t = drag.start.translation;
    return { rotation: drag.start.rotation, translation: [t[0] + x, t[1] + y, t[2] + z] };
  }

  #turned(drag: Drag, dx: number, dy: number): Motion {
    return turnedInView(this.#posing, drag.start, dx * RADIANS_PER_PIXEL, dy * RADIANS_PER_PIXEL);
  }
}

/** A motion turned further about the view's vertical and horizontal axes. */
export function turnedInView(posing: Posing, motion: Motion, across: number, down: number): Motion {
  const { camera, root } = posing.stage;
  const toRoot = root
    .getWorldQuaternion(new Quaternion())
    .invert()
    .multiply(camera.getWorldQuaternion(new Quaternion()));
  const axis = (x: number, y: number) => new Vector3(x, y, 0).applyQuaternion(toRoot);
  const turn = new Quaternion()
    .setFromAxisAngle(axis(0, 1), across)
    .multiply(new Quaternion().setFromAxisAngle(axis(1, 0), down));
  const R = motion.rotation;
  const before = new Matrix4().set(R[0], R[1], R[2], 0, R[3], R[4], R[5], 0, R[6], R[7], R[8], 0, 0, 0, 0, 1);
  const e = new Matrix4().makeRotationFromQuaternion(turn).multiply(before).elements;
  return {
    rotation: [e[0], e[4], e[8], e[1], e[5], e[9], e[2], e[6], e[10]],
    translation: motion.translation,
  };
}
