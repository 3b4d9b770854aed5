import type { Motion, PosingModel, PosingSession } from "../engine/index.ts";
import { keepHash, poseHash } from "./address.ts";
import { withoutMarks } from "./bare.ts";
import { chooser, choice, enable, h, hasMouse, mark, section, setText, toggle } from "./dom.ts";
import { handleButtons } from "./handle_buttons.ts";
import { ExportPanel } from "./export_panel.ts";
import { FurtherHandles } from "./further_handles.ts";
import { Hud } from "./hud.ts";
import { jigglePanel } from "./jiggle_panel.ts";
import { handleStates, REST } from "./key_states.ts";
import { lookSection, qualitySection } from "./look_panel.ts";
import type { Mode, Posing } from "./posing.ts";
import { mirrorPose } from "./mirror_pose.ts";
import { MotionFields } from "./motion_fields.ts";
import { isStatic, Polishing } from "./polishing.ts";
import { listenToKeys } from "./posing_keys.ts";
import { PosingScene, shownShape } from "./posing_scene.ts";
import { posingTimeline } from "./posing_timeline.ts";
import { pullRow } from "./pull_row.ts";
import { Pulling } from "./pulling.ts";
import { Readout } from "./readout.ts";
import { POSING, shortcutSheet } from "./shortcuts.ts";
import { VIEWS, type Stage } from "./stage.ts";
import type { View, ViewOptions } from "./view.ts";

const TURNS = hasMouse() ? "Shift-drag" : "choose Turn";

/** What drags do in each mode. */
const HELP: Record<Mode, string> = {
  move: `Drag a coloured part to move it, or ${TURNS} to turn it. Drag elsewhere to look around.`,
  turn: "Drag a coloured part to turn it. Drag elsewhere to look around.",
  pull: `Drag a coloured part to move it, or ${TURNS} to turn it. Drag beside the shape to look around.`,
};

/** A view whose model can be replaced by a better one, of these handles and perhaps more, also in the middle of a drag. */
export interface PosingView extends View {
  replace(model: PosingModel): Promise<void>;
}

/** Posing: handles on the stage, controls in the panel. */
export async function posingView(
  stage: Stage,
  module: WebAssembly.Module,
  model: PosingModel,
  options: ViewOptions,
): Promise<PosingView> {
  if (!options.keepView) stage.place(model.space.base, options.up);
  const scene = await PosingScene.create(stage, module, model, options);
  const { posing, gizmo, drag, surfaces } = scene;
  const pulling = new Pulling(posing, module, scene.signal);
  const pulls = pullRow(pulling, options.improving, () => keep());
  listenToKeys(posing, scene.signal);

  const hud = new Hud(
    model.name,
    `${model.space.vertices.toLocaleString("en")} surface vertices`,
    // nothing is known of the error of shapes that are pulled or heavy
    () => (isStatic(posing) ? posing.session : { certificate: () => null, outside: posing.session.outside }),
  );
  hud.dimension(model.dimension, model.dimension);
  let list = handleButtons(posing);
  const listed = h("div", { className: "list" }, ...list);
  const modes = choice<Mode>(
    "What a drag does",
    [
      ["move", "Move"],
      ["turn", "Turn"],
      ["pull", "Pull"],
    ],
    "move",
    (mode) => posing.setMode(mode),
  );
  const local = toggle("Own axes", "Arrows and rings along the handle's own axes; L", false, (on) => {
    posing.isLocal = on;
    stage.draw();
  });
  local.id = "own-axes";
  const { length, degrees } = posing.snapping;
  const snap = toggle("Snap", `Drags move by ${length} and turn by ${degrees} degrees; S`, false, (on) => {
    posing.snapping.isOn = on;
  });
  snap.id = "snap";
  const undo = h("button", { type: "button", title: "Ctrl+Z", onclick: () => posing.undo() }, "Undo");
  const redo = h(
    "button",
    { type: "button", title: "Ctrl+Shift+Z, Ctrl+Y", onclick: () => posing.redo() },
    "Redo",
  );
  const reset = h("button", { type: "button", title: "R", onclick: () => posing.reset() }, "Reset");
  const mirror = mirrorPose(posing);
  const figures = h("p", { className: "figures" });
  const fields = new MotionFields(model.diagonal, (...typed) => posing.edit([typed]));

  const polishing =
    options.polish &&
    new Polishing(
      posing,
      options.polish,
      (moved) => hud.polished(moved),
      (why) => hud.remark(`Not polished: ${why.charAt(0).toLowerCase()}${why.slice(1)}`),
    );
  posing.onSolved = (report) => {
    hud.remark("");
    hud.solved(report);
    polishing?.cancel();
    scene.follow();
    readout.ask();
  };
  posing.onReleased = () => {
    if (!posing.isOnTheWay && !posing.isDragging) void polishing?.ask();
  };
  /** Includes kept points: a better model may have them as handles when the page is loaded again. */
  const motions = () =>
    new Map([
      ...posing.motions.map((motion, handle) => [namesOf(posing)[handle], motion] as const),
      ...pulling.motions,
    ]);
  const keep = () => {
    if (!options.isFromFile) keepHash(() => poseHash(motions()));
  };
  const readout = new Readout(
    () =>
      [
        ...list.map((button, handle) => mark(button, "aria-pressed", handle === posing.selected)),
        modes.set(posing.mode),
        enable(undo, posing.history.canUndo),
        enable(redo, posing.history.canRedo),
        mirror.update(),
      ].includes(true),
    () => hud.warn(warningOf(posing.session)),
    () => {
      fields.show(posing.selected, posing.selected < 0 ? null : posing.session.motion(posing.selected));
      if (figures.hidden !== posing.selected >= 0) figures.hidden = posing.selected >= 0;
      return setText(figures, HELP[posing.mode]);
    },
    () => hud.update(),
  );
  posing.onChange = () => {
    scene.follow();
    gizmo.update();
    readout.now();
    pulls.show(posing.mode === "pull");
    if (!posing.isDragging) keep();
  };
  posing.beforeEdit = () => timeline.play(false);
  const start = model.handles.map(({ name }) => options.motions?.get(name));
  if (start.some((motion) => motion !== undefined)) posing.begin(start.map((motion) => motion ?? REST));
  else posing.onChange();
  stage.beforeFrame = (seconds) => {
    if (posing.isDragging) timeline.play(false);
    timeline.advance(seconds);
    posing.solveWishes();
    posing.advance(seconds);
    gizmo.update();
    polishing?.advance();
    look.legend.look();
    hud.frame(seconds);
    readout.advance();
  };
  stage.restored = () => {
    surfaces[0].refresh();
    ghosts.refresh();
  };
  stage.afterFrame = () => {
    if (posing.isOnTheWay || polishing?.isOnTheWay || timeline.isPlaying) stage.draw();
  };

  const polish = toggle("Polish", "Improves every shape at rest in the full space", true, (on) => {
    if (polishing) polishing.isOn = on;
    if (!on) hud.assess();
  });
  const others = polishing ? [h("div", { className: "row" }, polish)] : [];
  const qualityOf = (whole: number) =>
    qualitySection(
      whole,
      (d) => {
        posing.dimension = d;
        hud.dimension(d, whole);
      },
      ...others,
    );
  let quality = qualityOf(model.dimension);
  const replace = async (better: PosingModel) => {
    const session = await scene.sessionOf(better);
    const before = posing.session.model;
    const further = await FurtherHandles.between(module, before, better, pulling.points);
    await further.prepare(() => [...posing.history.states, ...timeline.states]);
    const pulled = session && (await pulling.pullsIn(session));
    if (!session || scene.signal.aborted) return; // the view was left meanwhile
    ghosts.clear();
    const { q } = posing.pulled ?? posing.session;
    const all = (motions: readonly Motion[]) => further.all(motions);
    scene.replace(session, {
      motions: further.inShape(posing.motions, q, posing.session.carriedBy),
      all,
      pulled: pulling.become(session, pulled),
    });
    timeline.become(handleStates(namesOf(posing)), all);
    if (list.length < better.handles.length) listed.replaceChildren(...(list = handleButtons(posing)));
    posing.onChange();
    pulling.onChange();
    hud.dimension(better.dimension, better.dimension);
    const next = qualityOf(better.dimension);
    quality.replaceWith(next);
    quality = next;
    stage.draw();
  };

  const sheet = shortcutSheet(POSING, (view) => stage.look(1, VIEWS[view]), scene.signal);
  const look = lookSection(stage, surfaces, model, options.up, sheet);
  const bare = () => {
    const { selected } = posing;
    posing.select(-1);
    const show = withoutMarks(stage.root);
    return () => {
      show();
      posing.select(selected);
    };
  };
  const takeAway = new ExportPanel(stage, {
    name: model.name,
    faces: model.faces,
    isFromFile: options.isFromFile,
    page: options.page && (() => options.page!(timeline.content)),
    shape: () => shownShape(posing),
    bare,
  });
  const { panel: timeline, ghosts } = posingTimeline(
    posing,
    model.name,
    options.isFromFile,
    () => scene.anotherSurface(),
    bare,
  );
  timeline.begin(options.timeline, model.timeline);
  const gravity = model.frames && { diagonal: model.diagonal, up: () => stage.up };
  const swing = jigglePanel(posing.jiggle, () => stage.draw(), gravity);
  stage.placed = () => swing.turn();
  const panel = [
    section(
      "Handles",
      listed,
      modes.element,
      figures,
      fields.element,
      pulls.element,
      h("div", { className: "row" }, local, snap, mirror.button),
      mirror.hint,
      h("div", { className: "row" }, undo, redo, reset),
      ...chooser(options.choose),
    ),
    quality,
    swing.element,
    timeline.element,
    look.element,
    takeAway.element,
  ];
  return {
    hud,
    label: "The shape. Keys: 1 to 9 choose a handle, arrows move or turn it.",
    panel,
    replace,
    get state() {
      return { motions: motions(), timeline: timeline.content };
    },
    script: {
      kind: "posing",
      get session() {
        return posing.session;
      },
      shown: () => shownShape(posing),
      strains: () => posing.surface.strains(),
      handle: (handle: number) => drag.screen(handle),
      onGpu: surfaces[0].onGpu,
      arrows: gizmo.arrows,
      timeline,
    },
    dispose: () => {
      takeAway.dispose();
      pulling.dispose();
      timeline.dispose();
      polishing?.cancel();
      readout.dispose();
      stage.rest();
      look.legend.dispose();
      hud.dispose();
      scene.dispose();
    },
  };
}

const namesOf = ({ session }: Posing) => session.model.handles.map(({ name }) => name);

function warningOf({ outside, model }: PosingSession): string {
  const parts = outside.map(({ handle, how }) => `${model.handles[handle].name}, ${how}`);
  return parts.length === 0 ? "" : `Beyond what was sampled: ${parts.join("; ")}`;
}
