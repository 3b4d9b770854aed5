import { Mesh, MeshBasicMaterial, Plane, Raycaster, SphereGeometry, Vector2, Vector3 } from "three";

import { placeOf, type FrameReport, type Hit, type PulledPoint, type Pulls } from "../engine/index.ts";
import { listenToPointers } from "./canvas_pointers.ts";
import type { Posing } from "./posing.ts";

const DOT = 0.008; // of the diagonal

/** Solves for the handles and for points that are pulled. */
export interface Pulled {
  readonly q: Float64Array;
  solve(): FrameReport;
}

/** Pulls on any point of the surface: press, pull, and let go or keep. Kept points hold the surface like handles. */
export class Pulling {
  /** Whether points stay where they were pulled to. */
  keeps = false;
  /** After points were kept or let go. */
  onChange: () => void = () => {};
  readonly #posing: Posing;
  readonly #module: WebAssembly.Module;
  readonly #canvas: HTMLCanvasElement;
  readonly #caster = new Raycaster();
  #kept: readonly PulledPoint[] = [];
  #pulls: Pulls | null = null;
  #drag: { pointer: number; plane: Plane } | null = null;
  #dots: Mesh[] = [];
  #turn = 0;

  constructor(posing: Posing, module: WebAssembly.Module, signal: AbortSignal) {
    [this.#posing, this.#module] = [posing, module];
    this.#canvas = posing.stage.renderer.domElement;
    const up = (event: PointerEvent) => void this.#up(event);
    const acts = {
      down: (event: PointerEvent) => void this.#down(event),
      move: (event: PointerEvent) => this.#move(event),
      up,
      cancel: up,
    };
    listenToPointers(this.#canvas, acts, signal);
  }

  /** Number of points that are kept. */
  get kept(): number {
    return this.#kept.length;
  }

  /** Lets go of all points. */
  letGo(): void {
    void this.#use([]);
  }

  /** Removes the dots; nothing is solved. */
  dispose(): void {
    this.#posing.pulled = null;
    this.#showDots([]);
  }

  async #down(event: PointerEvent): Promise<void> {
    const { stage, session, surface, mode } = this.#posing;
    if (mode !== "pull" || event.button !== 0 || event.target !== this.#canvas || this.#drag) return;
    if (this.#posing.isDragging) return; // a handle
    this.#aim(event);
    const toShape = surface.object.matrixWorld.clone().invert();
    const hit = surface.pick(this.#caster.ray.clone().applyMatrix4(toShape));
    if (!hit) return;
    stage.controls.enabled = false;
    this.#canvas.setPointerCapture(event.pointerId);
    const point = new Vector3(...hit.point).applyMatrix4(surface.object.matrixWorld);
    const facing = stage.camera.getWorldDirection(new Vector3());
    this.#drag = {
      pointer: event.pointerId,
      plane: new Plane().setFromNormalAndCoplanarPoint(facing, point),
    };
    const where = { corners: hit.corners, shares: sharesOf(hit, surface.positions()) };
    const now = this.#posing.pulled?.q ?? session.q;
    const target = placeOf(session.model, { ...where, target: [0, 0, 0] }, now, session.carriedBy);
    await this.#use([...this.#kept, { ...where, target }]);
  }

  #move(event: PointerEvent): void {
    if (event.pointerId !== this.#drag?.pointer || !this.#pulls) return;
    this.#aim(event);
    const place = this.#caster.ray.intersectPlane(this.#drag.plane, new Vector3());
    if (!place) return;
    const { x, y, z } = this.#posing.stage.root.worldToLocal(place);
    this.#pulls.target = [x, y, z];
    this.#take(this.#pulls);
  }

  async #up(event: PointerEvent): Promise<void> {
    if (event.pointerId !== this.#drag?.pointer) return;
    this.#drag = null;
    this.#posing.stage.controls.enabled = true;
    if (this.keeps && this.#pulls) this.#kept = this.#pulls.points;
    else await this.#use(this.#kept);
    this.onChange();
  }

  /** Pulls on these points only. */
  async #use(points: readonly PulledPoint[]): Promise<void> {
    const turn = ++this.#turn;
    const { session } = this.#posing;
    const pulls = points.length > 0 ? await session.pulls(this.#module, points) : null;
    if (turn !== this.#turn || session !== this.#posing.session) return; // a later one came first
    if (pulls) pulls.q = this.#posing.pulled?.q ?? session.q;
    this.#pulls = pulls;
    if (!this.#drag) this.#kept = points;
    this.#take(pulls);
    if (points.length === 0) this.onChange();
  }

  #take(pulls: Pulls | null): void {
    const { session } = this.#posing;
    this.#posing.pull(
      pulls && {
        get q() {
          return pulls.q;
        },
        solve: () => session.solvePulled(pulls),
      },
    );
    this.#showDots(pulls?.points ?? []);
  }

  #showDots(points: readonly PulledPoint[]): void {
    const { stage, session } = this.#posing;
    while (this.#dots.length < points.length) {
      const dot = new Mesh(
        new SphereGeometry(DOT * session.model.diagonal, 16, 12),
        new MeshBasicMaterial({ color: 0xffffff, depthTest: false }),
      );
      dot.renderOrder = 2;
      stage.root.add(dot);
      this.#dots.push(dot);
    }
    this.#dots.splice(points.length).forEach((dot) => {
      dot.removeFromParent();
      dot.geometry.dispose();
    });
    points.forEach(({ target: [x, y, z] }, k) => this.#dots[k].position.set(x, y, z));
  }

  #aim(event: PointerEvent): void {
    const box = this.#canvas.getBoundingClientRect();
    const [x, y] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    this.#caster.setFromCamera(new Vector2(2 * x - 1, 1 - 2 * y), this.#posing.stage.camera);
  }
}

/** Barycentric shares of a point in its triangle. */
function sharesOf({ point, corners }: Hit, shape: Float32Array): number[] {
  const [a, b, c] = corners.map((vertex) => new Vector3().fromArray(shape, 3 * vertex));
  const [u, v, w] = [b.sub(a), c.sub(a), new Vector3(...point).sub(a)];
  const normal = u.clone().cross(v);
  const size = normal.lengthSq();
  if (!(size > 0)) return [1, 0, 0];
  const second = w.clone().cross(v).dot(normal) / size;
  const third = u.clone().cross(w).dot(normal) / size;
  return [1 - second - third, second, third];
}
