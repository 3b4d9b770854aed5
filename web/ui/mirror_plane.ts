import { Color, Matrix4, Vector3 } from "three";

import type { Vector } from "../engine/motion.ts";
import type { RestMesh } from "../engine/rest_mesh.ts";
import { flat, Mesh, quad, type Geometry } from "../render/index.ts";
import { boxOf } from "./box_of.ts";
import type { Stage } from "./stage.ts";

const COLOR = new Color("#14b8ff");
const OPACITY = 0.22;
const UP: Record<RestMesh["up"], Vector3> = {
  x: new Vector3(1, 0, 0),
  y: new Vector3(0, 1, 0),
  z: new Vector3(0, 0, 1),
};

/** A mirror plane on the stage, as a square through the middle of the shape. */
export class MirrorPlane {
  readonly #stage: Stage;
  readonly #middle: Vector3;
  readonly #up: Vector3;
  readonly #square: Mesh;

  constructor(stage: Stage, { shape, diagonal, up }: RestMesh) {
    this.#stage = stage;
    this.#up = UP[up];
    this.#middle = boxOf(shape).getCenter(new Vector3());
    this.#square = new Mesh(square(diagonal), flat(COLOR, OPACITY, { depthWrite: false }));
    this.#square.name = "mirror plane";
    this.#square.visible = false;
    stage.root.add(this.#square);
  }

  /** Shows the plane across a unit normal, through a point. */
  put(normal: Vector, point: Vector): void {
    const across = new Vector3(...normal);
    const away = this.#middle
      .clone()
      .sub(new Vector3(...point))
      .dot(across);
    this.#square.position.copy(this.#middle).addScaledVector(across, -away);
    const side = this.#up.clone().cross(across);
    if (side.length() < 0.1) side.set(across.y, across.z, across.x).cross(across); // any along the plane
    side.normalize();
    const axes = new Matrix4().makeBasis(side, across.clone().cross(side), across);
    this.#square.quaternion.setFromRotationMatrix(axes);
    this.show(true);
  }

  show(on: boolean): void {
    this.#square.visible = on;
    this.#stage.draw();
  }

  dispose(): void {
    this.#square.removeFromParent();
    this.#square.geometry.dispose();
  }
}

/** Across z, around the origin. */
function square(side: number): Geometry {
  const half = side / 2;
  return quad([-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]);
}
