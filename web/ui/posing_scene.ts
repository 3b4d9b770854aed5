import { PosingSession, type PosingModel } from "../engine/index.ts";
import type { Continued } from "./continued.ts";
import { OwnLook } from "./own_look.ts";
import { Posing } from "./posing.ts";
import { HandleDrag } from "./posing_drag.ts";
import { Gizmo } from "./posing_gizmo.ts";
import { Marks } from "./posing_marks.ts";
import type { Stage } from "./stage.ts";
import { Surface } from "./surface.ts";

/** A posing model on the stage, with handles that are dragged: what the page and the web component have in common. */
export class PosingScene {
  readonly posing: Posing;
  readonly gizmo: Gizmo;
  readonly drag: HandleDrag;
  /** The one that is shown; the list stays the same when the model is replaced. */
  readonly surfaces: [Surface];
  #model: PosingModel;
  #marks: Marks;
  readonly #module: WebAssembly.Module;
  readonly #forceCpu: boolean;
  readonly #look: OwnLook | null;
  readonly #stop = new AbortController();

  static async create(
    stage: Stage,
    module: WebAssembly.Module,
    model: PosingModel,
    { forceCpu = false } = {},
  ): Promise<PosingScene> {
    return new PosingScene(stage, module, await PosingSession.create(module, model), forceCpu);
  }

  private constructor(stage: Stage, module: WebAssembly.Module, session: PosingSession, forceCpu: boolean) {
    [this.#module, this.#forceCpu, this.#model] = [module, forceCpu, session.model];
    this.#look = OwnLook.of(session.model.appearance, stage.renderer.graphics);
    this.surfaces = [this.#surfaceOf(stage, session.model)];
    stage.root.add(this.surfaces[0].object);
    this.posing = new Posing(stage, session, this.surfaces[0]);
    this.gizmo = new Gizmo(this.posing, this.#stop.signal);
    this.#marks = new Marks(this.posing);
    this.drag = new HandleDrag(this.posing, this.gizmo, this.#stop.signal);
    this.#warmUp();
  }

  /** The model that is shown. */
  get model(): PosingModel {
    return this.#model;
  }

  /** Aborted when the scene is disposed. */
  get signal(): AbortSignal {
    return this.#stop.signal;
  }

  /** A surface like the one that is shown, not yet on the stage. */
  anotherSurface(): Surface {
    return this.#surfaceOf(this.posing.stage, this.#model);
  }

  /** Puts marks where the handles are. The gizmo also follows the camera, before each picture. */
  follow(): void {
    this.#marks.update();
  }

  /** A session of a better model; null if the scene is disposed meanwhile. */
  async sessionOf(better: PosingModel): Promise<PosingSession | null> {
    const session = await PosingSession.create(this.#module, better);
    return this.#stop.signal.aborted ? null : session;
  }

  /** Continues with that session, also in the middle of a drag. */
  replace(session: PosingSession, continued: Continued): void {
    const { stage } = this.posing;
    const [before] = this.surfaces;
    this.#model = session.model;
    const surface = this.#surfaceOf(stage, session.model);
    this.surfaces[0] = surface;
    surface.lookAs(before);
    stage.root.add(surface.object);
    this.#marks.dispose();
    this.posing.replace(session, surface, continued);
    this.drag.warmUp();
    this.#marks = new Marks(this.posing);
    before.object.removeFromParent();
    before.dispose();
  }

  /** Runs what a drag runs a few times, and returns to rest. */
  #warmUp(): void {
    const { session, surface } = this.posing;
    const show = () => {
      surface.show(session.q);
      surface.carry(session.carriedBy);
      this.follow();
    };
    session.warmUp(show);
    show();
    this.drag.warmUp();
  }

  dispose(): void {
    this.#stop.abort();
    this.gizmo.dispose();
    this.#marks.dispose();
    this.surfaces[0].object.removeFromParent();
    this.surfaces[0].dispose();
    this.#look?.dispose();
  }

  #surfaceOf(stage: Stage, { space, faces, diagonal }: PosingModel): Surface {
    return new Surface(
      stage.renderer.graphics,
      space,
      faces,
      diagonal,
      this.#forceCpu,
      [space.base],
      this.#look,
    );
  }
}

/** Positions of the surface that is shown, after the first handle's motion. */
export function shownShape({ surface, session }: Posing): Float32Array<ArrayBuffer> {
  const shape = surface.shown();
  const { rotation: R, shift: t } = session.carriedBy;
  for (let i = 0; i < shape.length; i += 3) {
    const [x, y, z] = shape.subarray(i, i + 3);
    for (let a = 0; a < 3; a++) shape[i + a] = R[3 * a] * x + R[3 * a + 1] * y + R[3 * a + 2] * z + t[a];
  }
  return shape;
}
