import type { Motion, PosingSession } from "../engine/index.ts";
import { KeptKeys } from "./address.ts";
import { Ghosts, type Ghost } from "./ghosts.ts";
import { handleStates } from "./key_states.ts";
import type { Posing } from "./posing.ts";
import type { Surface } from "./surface.ts";
import { TimelinePanel } from "./timeline_panel.ts";

/** The timeline of posing: its keys are motions of all handles. */
export function posingTimeline(
  posing: Posing,
  name: string,
  isFromFile: boolean | undefined,
  makeSurface: () => Surface,
  bare: () => () => void,
): { panel: TimelinePanel<readonly Motion[]>; ghosts: Ghosts } {
  const ghosts = new Ghosts(posing.stage, makeSurface);
  const names = posing.session.model.handles.map((handle) => handle.name);
  const panel = new TimelinePanel<readonly Motion[]>(posing.stage, {
    name,
    kept: isFromFile ? null : new KeptKeys(`posing ${name}`),
    states: handleStates(names),
    handles: names,
    state: () => posing.motions,
    show: (motions) => motions.forEach((motion, handle) => posing.wish(handle, motion)),
    settle: () => {
      if (!posing.isDragging) posing.commit(); // else the end of the drag does
    },
    get surface() {
      return posing.surface;
    },
    shapes: (states) => shapesAt(posing.session, states),
    ghosts,
    bare,
  });
  return { panel, ghosts };
}

/** The shapes for motions of all handles; the present one stays. */
function shapesAt(session: PosingSession, states: readonly (readonly Motion[])[]): Ghost[] {
  if (states.length === 0) return [];
  const now = session.model.handles.map((_, handle) => session.motion(handle));
  const { q } = session;
  const found = states.map((motions) => {
    session.moveAll(new Map(motions.entries()));
    return { coefficients: session.q, carriedBy: session.carriedBy };
  });
  session.restore(now, q);
  return found;
}
