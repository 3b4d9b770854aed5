import type { PosingSession, RigidMap } from "../engine/index.ts";
import type { HandleMotion } from "../engine/messages.ts";
import type { Posing } from "./posing.ts";
import { Refused, type Server } from "./server.ts";

/** A frame of a posing model. */
interface Frame {
  readonly handles: readonly HandleMotion[];
  readonly q: readonly number[];
}

/** A frame after some iterations in the full space. */
interface Improved {
  /** Positions of the surface's vertices, where the handles are in the world. */
  readonly positions: Float32Array;
  /** Root mean square distance over the body, relative to the displacement from rest. */
  readonly moved: number | null;
}

/** Improves a frame; Refused where that is not possible now. */
export type Polish = (frame: Frame) => Promise<Improved>;

const MILLISECONDS = 150; // from the live shape to the improved one
/** Coordinates at rest, relative to those of a displacement of a tenth of the diagonal: where solves end that come from far
 * away. That is about a hundredth of a pixel. */
const REST = 1e-4;

/** Polishes at a server; `model()` is the number of the model there at that time. */
export function polishAt(server: Server, model: () => number): Polish {
  let newest = new AbortController();
  return async (frame) => {
    newest.abort(); // the server drops it as well, without an answer
    newest = new AbortController();
    const order = { type: "polish", model: model(), ...frame } as const;
    const { message, bytes } = await server.ask(order, "polished", newest.signal);
    if (!bytes) throw new Refused("The server sent no shape.");
    return { positions: new Float32Array(bytes), moved: message.moved };
  };
}

/** When a handle is released: asks for a better shape and moves to it. The next drag starts from the live shape. */
export class Polishing {
  readonly #posing: Posing;
  readonly #polish: Polish;
  readonly #onPolished: (moved: number | null) => void;
  readonly #onRefused: (why: string) => void;
  #isOn = true;
  #ticket = 0;
  #begin: number | null = null;

  /** `onPolished` gets how far a shape was moved, `onRefused` why one cannot be improved. */
  constructor(
    posing: Posing,
    polish: Polish,
    onPolished: (moved: number | null) => void,
    onRefused: (why: string) => void,
  ) {
    this.#onRefused = onRefused;
    this.#posing = posing;
    this.#polish = polish;
    this.#onPolished = onPolished;
  }

  /** Whether frames are polished; if not, the live shape is shown. */
  set isOn(on: boolean) {
    this.#isOn = on;
    this.cancel();
    if (on) void this.ask();
    else this.#posing.surface.blend(0);
    this.#posing.stage.draw();
  }

  /** Asks for the present frame; the answer is dropped if another frame came meanwhile. Shapes that are pulled, or bent by
   * gravity, stay as they are: the server does not know about that. The shape at rest is the full solution. */
  async ask(): Promise<void> {
    const { session, surface, stage } = this.#posing;
    if (!this.#isOn || !isStatic(this.#posing) || isAtRest(session)) return;
    const ticket = ++this.#ticket;
    const handles = session.model.handles.map((_, handle) => session.motion(handle) as HandleMotion);
    try {
      const { positions, moved } = await this.#polish({ handles, q: [...session.q] });
      if (ticket !== this.#ticket || positions.length !== 3 * surface.space.vertices) return;
      surface.goal = carriedBack(positions, session.carriedBy);
      this.#begin = performance.now();
      this.#onPolished(moved);
      stage.draw();
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      if (ticket === this.#ticket) this.#onRefused(error.message);
    }
  }

  /** Cancels, because another frame is shown: the live shape. */
  cancel(): void {
    this.#ticket++;
    this.#begin = null;
  }

  /** Before a picture: on the way to the improved shape. */
  advance(): void {
    if (this.#begin === null) return;
    const time = Math.min((performance.now() - this.#begin) / MILLISECONDS, 1);
    this.#posing.surface.blend(time * time * (3 - 2 * time));
    if (time === 1) this.#begin = null;
  }

  /** Whether the improved shape is not yet reached: another picture is needed. */
  get isOnTheWay(): boolean {
    return this.#begin !== null;
  }
}

/** Whether the handles alone make the shape. */
export function isStatic({ pulled, jiggle }: Posing): boolean {
  return !pulled && !jiggle.isHeavy;
}

/** Whether the shape is that at rest, perhaps carried along by all handles. */
function isAtRest({ q, model }: PosingSession): boolean {
  return Math.hypot(...q) <= REST * model.coordinateScale;
}

/** Positions before a rigid motion x -> R x + t. */
function carriedBack(positions: Float32Array, { rotation: R, shift }: RigidMap): Float32Array {
  const back = new Float32Array(positions.length);
  for (let i = 0; i < back.length; i += 3) {
    const x = positions[i] - shift[0];
    const y = positions[i + 1] - shift[1];
    const z = positions[i + 2] - shift[2];
    for (let a = 0; a < 3; a++) back[i + a] = R[a] * x + R[3 + a] * y + R[6 + a] * z;
  }
  return back;
}
