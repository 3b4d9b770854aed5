import { Color, Plane, Vector3 } from "three";

import {
  placeOf,
  reachOf,
  type FrameReport,
  type Hit,
  type PosingSession,
  type PulledPoint,
  type Pulls,
} from "../engine/index.ts";
import { IDENTITY, minus } from "../engine/motion.ts";
import { Dot } from "../render/index.ts";
import { listenToPointers } from "./canvas_pointers.ts";
import { rayAt } from "./canvas_ray.ts";
import type { Posing } from "./posing.ts";
import type { Motions } from "./view.ts";

const DOT = 0.02; // share of the diagonal
const WHITE = new Color("#ffffff");

/** A point that is pulled, with the name that it has as a handle. */
export interface KeptPoint extends PulledPoint {
  readonly name: string;
}

/** Solves for the handles and for points that are pulled. */
export interface Pulled {
  get q(): Float64Array;
  set q(q: ArrayLike<number>);
  solve(): FrameReport;
}

/** Pulls on any point of the surface: press, pull, and let go or keep. Kept points hold the surface like handles, until
 * a better model has them as handles. */
export class Pulling {
  /** Whether points stay where they were pulled to. */
  keeps = false;
  /** After points were kept or let go. */
  onChange: () => void = () => {};
  readonly #posing: Posing;
  readonly #module: WebAssembly.Module;
  readonly #canvas: HTMLCanvasElement;
  #kept: readonly KeptPoint[] = [];
  /** Those that are pulled now: the kept ones, and the one in hand. */
  #points: readonly KeptPoint[] = [];
  #pulls: Pulls | null = null;
  #drag: { pointer: number; plane: Plane } | null = null;
  #dots: Dot[] = [];
  #turn = 0;

  constructor(posing: Posing, module: WebAssembly.Module, signal: AbortSignal) {
    [this.#posing, this.#module] = [posing, module];
    this.#canvas = posing.stage.renderer.canvas;
    const up = (event: PointerEvent) => void this.#up(event);
    const acts = {
      down: (event: PointerEvent) => void this.#down(event),
      move: (event: PointerEvent) => this.#move(event),
      up,
      cancel: up,
    };
    listenToPointers(this.#canvas, acts, signal);
  }

  /** The points that are kept, and how far from rest they are, see `reachOf`. */
  get kept(): (KeptPoint & { reach: readonly [number, number, number] })[] {
    const { model, carriedBy } = this.#posing.session;
    return this.#kept.map((point) => ({ ...point, reach: reachOf(model, point, carriedBy) }));
  }

  /** Motions of kept points, as handles that do not turn. */
  get motions(): Motions {
    const { model } = this.#posing.session;
    return new Map(
      this.#kept.map((point) => {
        const translation = minus(point.target, placeOf(model, point, [], IDENTITY));
        return [point.name, { rotation: IDENTITY.rotation, translation }];
      }),
    );
  }

  /** All points that are pulled now. */
  get points(): readonly KeptPoint[] {
    const targets = this.#pulls?.points;
    return this.#points.map((point, k) => ({ ...point, target: targets?.[k].target ?? point.target }));
  }

  /** Pulls for a better model: of the points that are no handles there. */
  async pullsIn(session: PosingSession): Promise<Pulls | null> {
    for (;;) {
      const turn = this.#turn;
      const points = this.points.filter(isFreeIn(session));
      const pulls = points.length > 0 ? await session.pulls(this.#module, points) : null;
      if (turn === this.#turn) return pulls;
    }
  }

  /** Adopts those pulls, before that model is shown; `posing` continues with what this returns. */
  become(session: PosingSession, pulls: Pulls | null): Pulled | null {
    const held = this.points;
    this.#kept = this.#kept.filter(isFreeIn(session));
    this.#points = held.filter(isFreeIn(session));
    const inHand = this.#drag && held.at(-1);
    if (inHand && pulls) pulls.target = inHand.target;
    this.#pulls = pulls;
    this.#showDots(pulls?.points ?? []);
    return pulls && pulledBy(session, pulls);
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
    const toShape = surface.object.matrixWorld.clone().invert();
    const hit = surface.pick(rayAt(stage, event.clientX, event.clientY).applyMatrix4(toShape));
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
    await this.#use([...this.#kept, { ...where, target, name: this.#freeName() }]);
  }

  #move(event: PointerEvent): void {
    if (event.pointerId !== this.#drag?.pointer || !this.#pulls) return;
    const { stage } = this.#posing;
    const place = rayAt(stage, event.clientX, event.clientY).intersectPlane(this.#drag.plane, new Vector3());
    if (!place) return;
    const { x, y, z } = stage.root.worldToLocal(place);
    this.#pulls.target = [x, y, z];
    this.#take(this.#pulls);
  }

  async #up(event: PointerEvent): Promise<void> {
    if (event.pointerId !== this.#drag?.pointer) return;
    this.#drag = null;
    this.#posing.stage.controls.enabled = true;
    if (this.keeps && this.#pulls) this.#kept = this.points;
    else await this.#use(this.#kept);
    this.onChange();
  }

  /** Pulls on these points only. */
  async #use(points: readonly KeptPoint[]): Promise<void> {
    const turn = ++this.#turn;
    const { session } = this.#posing;
    const pulls = points.length > 0 ? await session.pulls(this.#module, points) : null;
    if (turn !== this.#turn) return; // a later one came first
    const isOther = session !== this.#posing.session; // a better model came meanwhile
    if (isOther) return this.#use(points.filter(isFreeIn(this.#posing.session)));
    if (pulls) pulls.q = this.#posing.pulled?.q ?? session.q;
    [this.#pulls, this.#points] = [pulls, points];
    if (!this.#drag) this.#kept = points;
    this.#take(pulls);
    if (points.length === 0) this.onChange();
  }

  #take(pulls: Pulls | null): void {
    this.#posing.pull(pulls && pulledBy(this.#posing.session, pulls));
    this.#showDots(pulls?.points ?? []);
  }

  #showDots(points: readonly PulledPoint[]): void {
    const { stage, session } = this.#posing;
    while (this.#dots.length < points.length) {
      const dot = new Dot(WHITE);
      dot.scale.setScalar(DOT * session.model.diagonal);
      stage.root.add(dot);
      this.#dots.push(dot);
    }
    this.#dots.splice(points.length).forEach((dot) => {
      dot.removeFromParent();
      dot.geometry.dispose();
    });
    points.forEach(({ target: [x, y, z] }, k) => this.#dots[k].position.set(x, y, z));
  }

  /** A name that no handle and no point has. */
  #freeName(): string {
    const handles = this.#posing.session.model.handles.map(({ name }) => name);
    const names = new Set([...handles, ...this.#kept.map(({ name }) => name)]);
    let number = 1;
    while (names.has(`point ${number}`)) number++;
    return `point ${number}`;
  }
}

/** Whether a point is no handle of a session's model. */
function isFreeIn({ model }: PosingSession): (point: KeptPoint) => boolean {
  const names = new Set(model.handles.map(({ name }) => name));
  return ({ name }) => !names.has(name);
}

function pulledBy(session: PosingSession, pulls: Pulls): Pulled {
  return {
    get q(): Float64Array {
      return pulls.q;
    },
    set q(q: ArrayLike<number>) {
      pulls.q = q;
    },
    solve: () => session.solvePulled(pulls),
  };
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
