import { Quaternion, Vector3 } from "three";

import { LEAST_WAY, listenToPointers } from "./canvas_pointers.ts";
import { dragOf, type Drag } from "./gizmo_drag.ts";
import { GizmoFrame } from "./gizmo_frame.ts";
import { GizmoParts, type GizmoPart } from "./gizmo_parts.ts";
import type { Posing } from "./posing.ts";
import { quaternionOf } from "./rotations.ts";

/** The length of its arrows as a share of half the height of the picture. */
const SIZE = 0.17;

/** Arrows or rings at the selected handle, along the axes of the model or of the handle, in their colours. */
export class Gizmo {
  readonly #posing: Posing;
  readonly #canvas: HTMLCanvasElement;
  readonly #parts = new GizmoParts();
  #frame: GizmoFrame | null = null;
  #active: GizmoPart | null = null;
  #drag: { pointer: number; handle: number; x: number; y: number; moved: boolean; ask: Drag } | null = null;

  constructor(posing: Posing, signal: AbortSignal) {
    this.#posing = posing;
    this.#canvas = posing.stage.renderer.canvas;
    posing.stage.scene.add(this.#parts.group);
    const up = (event: PointerEvent) => this.#up(event);
    const acts = { down: this.#down.bind(this), move: this.#move.bind(this), up, cancel: up };
    listenToPointers(this.#canvas, acts, signal);
  }

  get isDragging(): boolean {
    return this.#drag !== null;
  }

  /** Whether the pointer is on an arrow or ring. */
  get isActive(): boolean {
    return this.#active !== null;
  }

  /** Follows the selected handle and the camera: before each picture, and after another selection. */
  update(): void {
    const { selected, session, mode, stage, isLocal } = this.#posing;
    const { group } = this.#parts;
    group.visible = selected >= 0;
    if (selected < 0) {
      this.#frame = null;
      this.#activate(null);
      return;
    }
    const { camera, root } = stage;
    camera.updateMatrixWorld(); // it may just have jumped
    const turned = root.quaternion.clone();
    if (isLocal) turned.multiply(quaternionOf(session.motion(selected).rotation));
    const middle = new Vector3(...session.place(selected)).applyMatrix4(root.matrixWorld);
    const depth = -middle.clone().applyMatrix4(camera.matrixWorldInverse).z;
    const size = Math.max(SIZE * depth * Math.tan((camera.fov * Math.PI) / 360), 1e-6);
    this.#frame = new GizmoFrame(stage, middle, turned, size);
    group.position.copy(middle);
    group.quaternion.copy(turned);
    group.scale.setScalar(size);
    this.#parts.face(this.#frame.toCamera, turned);
    for (const part of this.#parts.all) {
      const isOfMode = (part.kind === "arrow" || part.kind === "square") === (mode !== "turn");
      part.mesh.visible = isOfMode && (part === this.#active || this.#frame.isUsable(part));
    }
  }

  /** For scripts and tests: directions on the stage and colours of the arrows. */
  readonly arrows = () => {
    const turned = this.#parts.group.getWorldQuaternion(new Quaternion());
    return this.#parts.all
      .filter(({ kind, axis }) => axis >= 0 && (kind === "arrow" || kind === "ring"))
      .filter(({ mesh }) => mesh.visible)
      .map(({ axis, color }) => ({
        direction: new Vector3().setComponent(axis, 1).applyQuaternion(turned).toArray(),
        color,
      }));
  };

  dispose(): void {
    if (this.#drag) this.#end();
    this.#parts.dispose();
  }

  #down(event: PointerEvent): void {
    const { stage, selected } = this.#posing;
    if (event.target !== this.#canvas || event.button !== 0 || this.#posing.isDragging) return;
    this.#look(event);
    if (!this.#active || !this.#frame) return;
    stage.controls.enabled = false;
    this.#canvas.setPointerCapture(event.pointerId);
    const start = this.#posing.motion(selected);
    const ask = dragOf(this.#frame, this.#active, start, event.clientX, event.clientY);
    this.#drag = {
      pointer: event.pointerId,
      handle: selected,
      x: event.clientX,
      y: event.clientY,
      moved: false,
      ask: (x, y) => this.#posing.snapped(start, ask(x, y)),
    };
    this.#posing.grab();
  }

  #move(event: PointerEvent): void {
    const { clientX: x, clientY: y } = event;
    const drag = this.#drag;
    if (!drag) {
      if (event.pointerType === "mouse" && event.buttons === 0) this.#look(event);
      return;
    }
    if (event.pointerId !== drag.pointer) return;
    drag.moved ||= Math.hypot(x - drag.x, y - drag.y) >= LEAST_WAY;
    if (drag.moved) this.#posing.wish(drag.handle, drag.ask(x, y));
  }

  /** The end, also of a drag that was cancelled meanwhile. */
  #up(event: PointerEvent): void {
    if (event.pointerId !== this.#drag?.pointer) return;
    const { moved } = this.#drag;
    this.#end();
    if (event.pointerType !== "mouse") this.#activate(null); // nothing hovers
    if (moved) this.#posing.commit();
    else this.#posing.release();
  }

  #end(): void {
    this.#drag = null;
    this.#posing.stage.controls.enabled = true;
  }

  /** Finds the part below the pointer. */
  #look({ clientX, clientY, pointerType, target }: PointerEvent): void {
    const isOn = target === this.#canvas && !this.#posing.isDragging;
    const isTouch = pointerType === "touch";
    const parts = this.#parts.all;
    this.#activate((isOn && this.#frame?.partAt(parts, clientX, clientY, isTouch)) || null);
  }

  #activate(part: GizmoPart | null): void {
    if (part === this.#active) return;
    if (this.#active) this.#active.isActive = false;
    if (part) part.isActive = true;
    this.#active = part;
    this.#posing.stage.draw();
  }
}
