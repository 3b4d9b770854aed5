import { Mesh, Object3D, Vector3 } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";

import type { Motion } from "../engine/index.ts";
import { AXIS_COLORS } from "./axis_colors.ts";
import type { Posing } from "./posing.ts";
import { quaternionOf, rotationOf } from "./rotations.ts";
import type { Axis } from "./stage.ts";

const [X, Y, Z] = AXIS_COLORS;
/** Of the arrow that the pointer is on. */
const ACTIVE = "#ffd23f";

/** Which colour the arrows along the stage's x, y (up) and z have, by the model's axis that points up. */
const COLORS: Record<Axis, readonly [string, string, string]> = {
  x: [Y, X, Z],
  y: [X, Y, Z],
  z: [X, Z, Y],
};

const WARMING = 12; // looks

/** Arrows or rings at the selected handle. */
export class Gizmo {
  readonly #controls: TransformControls;
  readonly #proxy = new Object3D();
  readonly #posing: Posing;
  readonly #canvas: HTMLCanvasElement;
  #colored = "";
  #start: Motion | null = null;

  constructor(posing: Posing) {
    const { stage } = posing;
    this.#posing = posing;
    this.#canvas = stage.renderer.domElement;
    this.#controls = new TransformControls(stage.camera, this.#canvas);
    this.#controls.size = 0.62;
    stage.root.add(this.#proxy);
    stage.scene.add(this.#controls.getHelper());
    this.#controls.addEventListener("change", () => stage.draw());
    this.#controls.addEventListener("objectChange", () => this.#wish());
    this.#controls.addEventListener("dragging-changed", (event) => {
      stage.controls.enabled = !event.value;
      this.#start = posing.motion(posing.selected);
      if (event.value) posing.grab();
      else posing.commit();
    });
  }

  /** Searches for its arrows a few times, as a pointer that approaches does, so that the browser makes fast code. */
  warmUp(): void {
    const helper = this.#controls.getHelper();
    this.#controls.attach(this.#proxy);
    helper.updateMatrixWorld(true);
    const middle = new Vector3().setFromMatrixPosition(this.#proxy.matrixWorld);
    const { x, y } = middle.project(this.#posing.stage.camera);
    for (let time = 0; time < WARMING; time++)
      this.#controls.pointerHover({ x: x + 0.01 * time, y: y + 0.01 * time, button: -1 } as never);
    this.#controls.detach();
  }

  /** Whether it listens to the pointer. */
  set isListening(on: boolean) {
    this.#controls.enabled = on;
  }

  /** Whether a press at this place would take hold of an arrow or ring. */
  isBelow(event: PointerEvent): boolean {
    if (this.#posing.selected < 0) return false;
    const box = this.#canvas.getBoundingClientRect();
    const x = (2 * (event.clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (event.clientY - box.top)) / box.height;
    this.#controls.pointerHover({ x, y, button: -1 } as never);
    return this.#controls.axis !== null;
  }

  /** Cancels the present drag, as the posing does. */
  cancel(): void {
    if (!this.#controls.dragging) return;
    this.#controls.reset();
    this.#controls.pointerUp(null);
  }

  /** Colours arrows and rings as the model's axes that they are along; before each picture. */
  color(): void {
    const { stage, isLocal } = this.#posing;
    const colored = `${stage.up} ${isLocal}`;
    if (colored === this.#colored) return;
    this.#colored = colored;
    this.#controls.setSpace(isLocal ? "local" : "world");
    this.#controls.setColors(...(isLocal ? AXIS_COLORS : COLORS[stage.up]), ACTIVE);
  }

  /** Follows the selected handle. */
  update(): void {
    const { selected, session, mode } = this.#posing;
    if (selected < 0) {
      this.#controls.detach();
      return;
    }
    if (this.#controls.object !== this.#proxy) this.#controls.attach(this.#proxy);
    this.#controls.setMode(mode === "move" ? "translate" : "rotate");
    if (this.#controls.dragging) return;
    this.#proxy.position.set(...session.place(selected));
    this.#proxy.quaternion.copy(quaternionOf(session.motion(selected).rotation));
    this.#proxy.updateMatrixWorld(true);
  }

  /** For scripts and tests: directions on the stage and colours of the arrows. */
  readonly arrows = () => {
    const found: { direction: number[]; color: string }[] = [];
    this.#controls.getHelper().traverse((part) => {
      if (!(part instanceof Mesh) || !/^[XYZ]$/.test(part.name) || part.material.opacity < 0.9) return;
      const along = new Vector3().setComponent("XYZ".indexOf(part.name), 1).applyQuaternion(part.quaternion);
      found.push({ direction: along.toArray(), color: `#${part.material.color.getHexString()}` });
    });
    return found;
  };

  dispose(): void {
    this.#controls.detach();
    this.#controls.getHelper().removeFromParent();
    this.#controls.dispose();
    this.#proxy.removeFromParent();
  }

  #wish(): void {
    const { selected, session } = this.#posing;
    const { center } = session.model.handles[selected];
    const { x, y, z } = this.#proxy.position;
    const asked: Motion = {
      rotation: rotationOf(this.#proxy.quaternion),
      translation: [x - center[0], y - center[1], z - center[2]],
    };
    this.#posing.wish(selected, this.#posing.snapped(this.#start ?? asked, asked));
  }
}
