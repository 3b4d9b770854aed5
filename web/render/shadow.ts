import { Matrix4, Vector3 } from "three";

import type { Graphics } from "./graphics.ts";
import type { Mesh } from "./mesh.ts";
import type { Uniform } from "./program.ts";
import { KEY_DISTANCE, type Studio } from "./studio.ts";
import { Target } from "./target.ts";

const SIDE = 1024; // texels
/** What the key light sees, around the origin. */
const [HALF, NEAR, FAR] = [1.3, 0.5, 6];
const [ORIGIN, UP] = [new Vector3(), new Vector3(0, 1, 0)];
const NOTHING = "void main() {}";

/** From the range -1 to 1 to texture coordinates from 0 to 1. */
const TO_TEXELS = new Matrix4().set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1);

/** How far the key light gets: depths of what it sees first. */
export class Shadow {
  readonly uniforms: Readonly<Record<"shadowMap" | "shadowMatrix", Uniform>>;
  readonly #graphics: Graphics;
  readonly #studio: Studio;
  readonly #target: Target;
  readonly #projection = new Matrix4().makeOrthographic(-HALF, HALF, HALF, -HALF, NEAR, FAR);
  readonly #view = new Matrix4();
  readonly #matrix = new Matrix4();

  constructor(graphics: Graphics, studio: Studio) {
    [this.#graphics, this.#studio] = [graphics, studio];
    this.#target = new Target(graphics, { format: "depth", width: SIDE, height: SIDE });
    this.uniforms = {
      shadowMap: { value: this.#target.texture },
      shadowMatrix: { value: this.#matrix.elements },
    };
  }

  /** Draws the depths of the meshes that cast shadows. */
  draw(meshes: readonly Mesh[]): void {
    const { gl } = this.#graphics;
    this.#look();
    this.#target.bind();
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    const seen = { view: { value: this.#view.elements }, projection: { value: this.#projection.elements } };
    for (const mesh of meshes) if (mesh.castsShadow) mesh.draw(this.#graphics, NOTHING, seen);
  }

  dispose(): void {
    this.#target.dispose();
  }

  #look(): void {
    const { key } = this.#studio;
    const place = key.clone().multiplyScalar(KEY_DISTANCE);
    this.#view.lookAt(key, ORIGIN, UP).setPosition(place).invert();
    this.#matrix.copy(TO_TEXELS).multiply(this.#projection).multiply(this.#view);
  }
}
