import { Box3, Group, PerspectiveCamera, Sphere, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { Ground, Renderer, Studio } from "../render/index.ts";
import { boxOf } from "./box_of.ts";

export type Axis = "x" | "y" | "z";

export function isAxis(text: string | null): text is Axis {
  return text === "x" || text === "y" || text === "z";
}

/** The margin around a shape in a small picture, as a share of its size. */
const MARGIN = 0.05;

/** The direction from the middle to the camera. */
const VIEW = new Vector3(0.62, 0.36, 0.8).normalize();
/** Directions of named views; that from above is not quite vertical, so that the picture has an up. */
export const VIEWS: Record<string, Vector3> = {
  front: new Vector3(0, 0, 1),
  side: new Vector3(1, 0, 0),
  top: new Vector3(0, 1, 1e-3).normalize(),
};

/** Canvas, camera, studio light and ground. Models stand in `root`, which is about one unit large. */
export class Stage {
  readonly renderer: Renderer;
  readonly scene = new Group();
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 50);
  readonly root = new Group();
  readonly controls: OrbitControls;
  /** Which axis of the model points up. */
  up: Axis = "z";
  /** Called before each picture that is drawn. */
  beforeFrame: (seconds: number) => void = () => {};
  /** Called after a model was placed with an axis up. */
  placed: () => void = () => {};
  /** Called after each picture: animations ask for the next one here. */
  afterFrame: () => void = () => {};
  /** Called after each picture, whatever is shown. */
  drawn: () => void = () => {};
  /** Called when lost graphics are back: what was computed there is gone. */
  restored: () => void = () => {};
  readonly #ground = new Ground();
  readonly #resized = new ResizeObserver(() => this.fit());
  #height = 0.5;
  readonly #before = new PerspectiveCamera(); // while another picture is taken
  /** The animation frame that was asked for; 0: none. */
  #asked = 0;
  #last = 0;

  constructor(canvas: HTMLCanvasElement) {
    this.controls = new OrbitControls(this.camera, canvas);
    this.renderer = new Renderer(canvas, new Studio(VIEW, this.controls.target));
    this.controls.minDistance = 0.15;
    this.controls.maxDistance = 8;
    this.controls.addEventListener("change", () => this.draw());
    this.scene.add(this.root, this.#ground);
    // after the renderer, which listens as well
    canvas.addEventListener("webglcontextrestored", () => {
      this.restored();
      this.draw();
    });
    this.#resized.observe(canvas.parentElement!);
    this.fit();
  }

  /** Asks for a picture. Several requests before it is drawn, also by `beforeFrame`, give one picture. */
  draw(): void {
    this.#asked ||= requestAnimationFrame((now) => this.#picture(now));
  }

  /** Draws at once, in place of the picture that was asked for. */
  drawNow(): void {
    cancelAnimationFrame(this.#asked);
    this.#picture(performance.now());
  }

  #picture(now: number): void {
    const seconds = (now - this.#last) / 1000;
    this.#last = now;
    try {
      this.beforeFrame(seconds);
    } finally {
      this.#asked = 0;
    }
    this.renderer.render(this.scene, this.camera);
    this.afterFrame();
    this.drawn();
  }

  /** Forgets the view that was shown. */
  rest(): void {
    this.beforeFrame = this.afterFrame = this.restored = this.placed = () => {};
  }

  /** Gives the graphics back: browsers have few for a page. The canvas cannot be drawn on again. */
  dispose(): void {
    this.rest();
    this.#resized.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
  }

  /** Puts the bounding box of a shape on the ground, its diagonal one unit long, with an axis up. */
  place(shape: Float32Array, up: Axis): void {
    this.up = up;
    const box = boxOf(shape);
    const diagonal = box.getSize(new Vector3()).length();
    this.root.scale.setScalar(1 / diagonal);
    this.root.rotation.set(up === "z" ? -Math.PI / 2 : 0, 0, up === "x" ? Math.PI / 2 : 0);
    const foot = box.getCenter(new Vector3());
    foot[up] = box.min[up];
    this.root.position.set(0, 0, 0);
    this.root.updateMatrixWorld(true);
    this.root.position.copy(this.root.localToWorld(foot).negate());
    this.root.updateMatrixWorld(true);
    this.#height = (box.max[up] - box.min[up]) / diagonal;
    this.look();
    this.placed();
  }

  /** The first view: from the front, a little to the side and above; or from another direction. `width` is what must be
   * seen across. */
  look(width = 1, from = VIEW): void {
    const target = new Vector3(0, 0.5 * this.#height, 0);
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    const distance = Math.max(0.5 / half, (0.5 * width) / half / this.camera.aspect);
    this.controls.target.copy(target);
    this.camera.position.copy(from).multiplyScalar(distance).add(target);
    this.controls.update();
    this.draw();
  }

  /** Looks at a shape that stands in the root, which fills the square picture; the ground is hidden. For small pictures. */
  lookAt(shape: Float32Array): void {
    const sphere = boxOf(shape).getBoundingSphere(new Sphere()).applyMatrix4(this.root.matrixWorld);
    this.#ground.visible = false;
    this.#before.copy(this.camera);
    this.camera.position
      .copy(VIEW)
      .multiplyScalar(sphere.radius / Math.sin((this.camera.fov * Math.PI) / 360))
      .add(sphere.center);
    this.camera.lookAt(sphere.center);
    this.camera.aspect = 1;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.#fill(shape);
  }

  /** Narrows the view to the square around a shape: most shapes are far from filling their sphere. */
  #fill(shape: Float32Array): void {
    const seen = new Box3();
    const point = new Vector3();
    for (let i = 0; i < shape.length; i += 3)
      seen.expandByPoint(point.fromArray(shape, i).applyMatrix4(this.root.matrixWorld).project(this.camera));
    const size = seen.getSize(new Vector3());
    const half = (1 + 2 * MARGIN) * 0.5 * Math.max(size.x, size.y);
    const middle = seen.getCenter(new Vector3());
    this.camera.setViewOffset(1, 1, (1 + middle.x - half) / 2, (1 - middle.y - half) / 2, half, half);
  }

  /** Undoes `lookAt`. */
  lookBack(): void {
    this.#ground.visible = true;
    this.camera.clearViewOffset();
    this.camera.aspect = this.#before.aspect;
    this.camera.updateProjectionMatrix();
    this.camera.position.copy(this.#before.position);
    this.camera.quaternion.copy(this.#before.quaternion);
    this.camera.updateMatrixWorld();
  }

  set dark(dark: boolean) {
    this.#ground.opacity = dark ? 0.5 : 0.26;
    this.draw();
  }

  /** Fits the canvas to its place. */
  fit(): void {
    const { clientWidth, clientHeight } = this.renderer.canvas.parentElement!;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, Math.min(window.devicePixelRatio, 2));
    const aspect = clientWidth / clientHeight;
    // keeps the visible width when the window becomes narrow
    const narrowness = (a: number) => Math.max(1, 1 / a);
    const away = this.camera.position.clone().sub(this.controls.target);
    away.multiplyScalar(narrowness(aspect) / narrowness(this.camera.aspect));
    this.camera.position.copy(this.controls.target).add(away);
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
