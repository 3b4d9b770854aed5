import { type Color, type Object3D, type PerspectiveCamera, Vector3 } from "three";

import { Graphics } from "./graphics.ts";
import { Mesh } from "./mesh.ts";
import { Shadow } from "./shadow.ts";
import type { Studio } from "./studio.ts";

/** Draws a scene in studio light on a canvas. */
export class Renderer {
  readonly graphics: Graphics;
  /** What is behind everything; null is transparent. */
  background: Color | null = null;
  readonly #studio: Studio;
  readonly #shadow: Shadow;

  /** Throws an Error in browsers without WebGL 2. */
  constructor(canvas: HTMLCanvasElement, studio: Studio) {
    this.graphics = new Graphics(canvas);
    this.#studio = studio;
    this.#shadow = new Shadow(this.graphics, studio);
  }

  get canvas(): HTMLCanvasElement {
    return this.graphics.canvas;
  }

  get gl(): WebGL2RenderingContext {
    return this.graphics.gl;
  }

  /** Sets the size of the picture in pixels of the page. Each has `pixelRatio` pixels along a side. */
  setSize(width: number, height: number, pixelRatio: number): void {
    const [across, down] = [width, height].map((side) => Math.floor(side * pixelRatio));
    // setting the size empties the canvas, also if it is the same
    if (this.canvas.width !== across) this.canvas.width = across;
    if (this.canvas.height !== down) this.canvas.height = down;
  }

  /** Draws all meshes that are visible, with the key light's shadow. Nothing is drawn while the context is lost. */
  render(scene: Object3D, camera: PerspectiveCamera): void {
    if (this.graphics.isLost) return; // all is drawn again once it is back
    const meshes = this.#meshes(scene, camera);
    this.#shadow.draw(meshes);
    this.#draw(meshes, camera, this.canvas.width, this.canvas.height);
  }

  /** Draws them on a square in the lower left corner, with the shadow as it was, and empties the rest. */
  renderCorner(scene: Object3D, camera: PerspectiveCamera, side: number): void {
    if (!this.graphics.isLost) this.#draw(this.#meshes(scene, camera), camera, side, side);
  }

  /** Begins to make the programs and geometries of all meshes, also of those that are hidden: the first picture of them is
   * not late. */
  prepare(scene: Object3D): void {
    scene.traverse((object) => {
      if (!(object instanceof Mesh)) return;
      this.graphics.program(object.material.vertex, object.material.fragment);
      object.geometry.bind(this.graphics);
    });
    this.gl.bindVertexArray(null);
  }

  dispose(): void {
    this.#shadow.dispose();
    this.graphics.dispose();
  }

  /** What is visible, after all has taken its place and the lights have followed the camera. */
  #meshes(scene: Object3D, camera: PerspectiveCamera): Mesh[] {
    scene.updateMatrixWorld();
    camera.updateMatrixWorld();
    this.#studio.follow(camera);
    return visibleMeshes(scene);
  }

  #draw(meshes: readonly Mesh[], camera: PerspectiveCamera, width: number, height: number): void {
    const { graphics } = this;
    const { gl } = graphics;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    this.#clear();
    const seen = {
      ...this.#studio.uniforms,
      ...this.#shadow.uniforms,
      view: { value: camera.matrixWorldInverse.elements },
      projection: { value: camera.projectionMatrix.elements },
      eye: { value: camera.matrixWorld.elements.slice(12, 15) },
    };
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    for (const mesh of inOrder(meshes, camera)) {
      const { depthTest, depthWrite, fragment } = mesh.material;
      depthTest ? gl.enable(gl.DEPTH_TEST) : gl.disable(gl.DEPTH_TEST);
      gl.depthMask(depthWrite);
      mesh.draw(graphics, fragment, seen);
    }
    gl.disable(gl.BLEND);
    gl.bindVertexArray(null);
  }

  #clear(): void {
    const { gl } = this.graphics;
    const hex = this.background?.getHex() ?? 0; // in sRGB, as the canvas
    const [red, green, blue] = [16, 8, 0].map((shift) => ((hex >> shift) & 255) / 255);
    gl.clearColor(red, green, blue, this.background ? 1 : 0);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }
}

function visibleMeshes(scene: Object3D): Mesh[] {
  const found: Mesh[] = [];
  scene.traverseVisible((object) => {
    if (object instanceof Mesh) found.push(object);
  });
  return found;
}

/** Opaque meshes, then transparent ones from far to near; within both groups, `renderOrder` comes first. */
function inOrder(meshes: readonly Mesh[], camera: PerspectiveCamera): Mesh[] {
  const place = new Vector3();
  const depths = new Map(
    meshes.map((mesh) => [
      mesh,
      place.setFromMatrixPosition(mesh.matrixWorld).applyMatrix4(camera.matrixWorldInverse).z,
    ]),
  );
  return [...meshes].sort(
    (a, b) =>
      Number(a.material.isTransparent) - Number(b.material.isTransparent) ||
      a.renderOrder - b.renderOrder ||
      (a.material.isTransparent ? depths.get(a)! - depths.get(b)! : 0),
  );
}
