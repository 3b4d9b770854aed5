import { closestMap, placeOf, PosingSession } from "../engine/index.ts";
import type { Motion, PosingModel, Pulls, RigidMap } from "../engine/index.ts";
import { IDENTITY, motionOfMap } from "../engine/motion.ts";
import { approach } from "./motion_parts.ts";
import { nextTask } from "./next_task.ts";
import type { KeptPoint } from "./pulling.ts";

type Motions = readonly Motion[];

/** Motions of the handles that a better model has beyond those of the model before, in any state of that one: the
 * rigid motions that are closest to how their vertices moved. So poses, keys and steps of undo keep their shapes. */
export class FurtherHandles {
  /** Session of the model before; null if the better one has the same handles. */
  readonly #session: PosingSession | null;
  readonly #pulls: Pulls | null;
  /** Surface vertices of each further handle, and its centre. */
  readonly #handles: readonly { vertices: readonly number[]; center: readonly [number, number, number] }[];
  readonly #found = new Map<Motions, Motions>();

  /** `points` are pulled in all states of the model before; some of them are the further handles. */
  static async between(
    module: WebAssembly.Module,
    before: PosingModel,
    better: PosingModel,
    points: readonly KeptPoint[],
  ): Promise<FurtherHandles> {
    if (better.handles.length === before.handles.length) return new FurtherHandles(null, null, better, []);
    const session = await PosingSession.create(module, before);
    const pulls = points.length > 0 ? await session.pulls(module, points) : null;
    return new FurtherHandles(session, pulls, better, points);
  }

  private constructor(
    session: PosingSession | null,
    pulls: Pulls | null,
    better: PosingModel,
    points: readonly KeptPoint[],
  ) {
    [this.#session, this.#pulls] = [session, pulls];
    const known = (session?.model ?? better).handles.length;
    this.#handles = better.handles.slice(known).map(({ name, center }, k) => {
      const vertices: number[] = [];
      better.handleOfVertex.forEach((owner, vertex) => owner === known + k && vertices.push(vertex));
      // three at least, for a rotation
      const corners = points.find((point) => point.name === name)?.corners ?? [];
      return { vertices: [...new Set([...vertices, ...corners])], center };
    });
  }

  /** Finds the motions for states ahead of time, one after the other in pauses of the page. */
  async prepare(states: () => readonly Motions[]): Promise<void> {
    for (;;) {
      const next = states().find((motions) => !this.#found.has(motions));
      if (!next || !this.#session) return;
      this.all(next);
      await nextTask();
    }
  }

  /** Motions of all handles of the better model, for those of the model before. */
  all(motions: Motions): Motions {
    const [session, pulls] = [this.#session, this.#pulls];
    if (!session) return motions;
    const known = this.#found.get(motions);
    if (known) return known;
    session.reset();
    approach(session, motions);
    if (pulls) {
      pulls.q = session.q;
      session.solvePulled(pulls);
    }
    const found = this.inShape(motions, (pulls ?? session).q, session.carriedBy);
    this.#found.set(motions, found);
    return found;
  }

  /** The same in a shape that is known: coordinates in the model before, carried by a rigid map. */
  inShape(motions: Motions, q: ArrayLike<number>, carriedBy: RigidMap): Motions {
    if (!this.#session) return motions;
    const { model } = this.#session;
    const further = this.#handles.map(({ vertices, center }) => {
      const places = vertices.map((vertex) => {
        const point = { corners: [vertex], shares: [1], target: center };
        return { rest: placeOf(model, point, [], IDENTITY), now: placeOf(model, point, q, carriedBy) };
      });
      const map = closestMap(
        places.map(({ rest }) => rest),
        places.map(({ now }) => now),
      );
      return motionOfMap(map, center);
    });
    return [...motions, ...further];
  }
}
