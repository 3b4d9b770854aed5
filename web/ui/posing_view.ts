import { PosingSession, type PosingModel } from "../engine/index.ts";
import { keepHash, poseHash } from "./address.ts";
import { chooser, choice, enable, h, mark, section, setText, toggle } from "./dom.ts";
import { handleColor } from "./handle_colors.ts";
import { ExportPanel } from "./export_panel.ts";
import { Hud } from "./hud.ts";
import { jigglePanel } from "./jiggle_panel.ts";
import { lookSection, qualitySection } from "./look_panel.ts";
import { Posing, type Mode } from "./posing.ts";
import { MotionFields } from "./motion_fields.ts";
import { Polishing } from "./polishing.ts";
import { HandleDrag } from "./posing_drag.ts";
import { Gizmo } from "./posing_gizmo.ts";
import { listenToKeys } from "./posing_keys.ts";
import { Marks } from "./posing_marks.ts";
import { posingTimeline } from "./posing_timeline.ts";
import { pullRow } from "./pull_row.ts";
import { Pulling } from "./pulling.ts";
import { Readout } from "./readout.ts";
import { POSING, shortcutSheet } from "./shortcuts.ts";
import { VIEWS, type Stage } from "./stage.ts";
import { Surface } from "./surface.ts";
import type { Motions, View, ViewOptions } from "./view.ts";

const HELP = "Drag a coloured part to move it, or Shift-drag to turn it. Drag elsewhere to look around.";

/** A view whose model can be replaced by a better one of the same handles, also in the middle of a drag. */
export interface PosingView extends View {
  replace(model: PosingModel): Promise<void>;
  /** Where the handles are, by name. */
  readonly motions: Motions;
  /** The content of a timeline file; null without keys. */
  readonly timeline: string | null;
}

/** Posing: handles on the stage, controls in the panel. */
export async function posingView(
  stage: Stage,
  module: WebAssembly.Module,
  model: PosingModel,
  options: ViewOptions,
): Promise<PosingView> {
  const surfaceOf = ({ space, faces, diagonal }: PosingModel) =>
    new Surface(stage.renderer, space, faces, diagonal, options.forceCpu, [space.base]);
  let newest = model;
  const surfaces = [surfaceOf(model)];
  stage.root.add(surfaces[0].object);
  if (!options.keepView) stage.place(model.space.base, options.up);
  const session = await PosingSession.create(module, model);
  const posing = new Posing(stage, session, surfaces[0]);
  const stop = new AbortController();
  const gizmo = new Gizmo(posing);
  let marks = new Marks(posing);
  const drag = new HandleDrag(posing, gizmo, stop.signal);
  const pulling = new Pulling(posing, module, stop.signal);
  const pulls = pullRow(pulling);
  const follow = () => {
    gizmo.update();
    marks.update();
  };
  posing.warmUp(follow);
  gizmo.warmUp();
  drag.warmUp();
  listenToKeys(posing, stop.signal);

  const hud = new Hud(
    model.name,
    `${model.space.vertices.toLocaleString("en")} surface vertices`,
    () => posing.session,
  );
  hud.dimension(model.dimension, model.dimension);
  const list = model.handles.map(({ name }, handle) => {
    const swatch = h("i", { className: "swatch", "aria-hidden": true });
    swatch.style.background = handleColor(handle);
    const act = () => posing.select(posing.selected === handle ? -1 : handle);
    return h("button", { type: "button", "aria-pressed": false, onclick: act }, swatch, name);
  });
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
  const undo = h("button", { type: "button", title: "Ctrl+Z", onclick: () => posing.undo() }, "Undo");
  const redo = h(
    "button",
    { type: "button", title: "Ctrl+Shift+Z, Ctrl+Y", onclick: () => posing.redo() },
    "Redo",
  );
  const reset = h("button", { type: "button", title: "R", onclick: () => posing.reset() }, "Reset");
  const figures = h("p", { className: "figures" });
  const fields = new MotionFields(model.diagonal, (motion) => {
    posing.wish(posing.selected, motion);
    posing.commit();
  });

  const polishing =
    options.polish &&
    new Polishing(
      posing,
      options.polish,
      (moved) => hud.polished(moved),
      (why) => hud.remark(`Not polished: ${why.charAt(0).toLowerCase()}${why.slice(1)}`),
    );
  posing.onCancelled = () => gizmo.cancel();
  posing.onSolved = (report) => {
    hud.remark("");
    hud.solved(report);
    polishing?.cancel();
    follow();
    readout.ask();
  };
  posing.onReleased = () => {
    if (!posing.jiggle.moves) void polishing?.ask();
  };
  const motions = () =>
    new Map(posing.motions.map((motion, handle) => [model.handles[handle].name, motion] as const));
  const readout = new Readout(
    () =>
      [
        ...list.map((button, handle) => mark(button, "aria-pressed", handle === posing.selected)),
        modes.set(posing.mode),
        enable(undo, posing.canUndo),
        enable(redo, posing.canRedo),
      ].includes(true),
    () => hud.warn(warningOf(posing.session)),
    () => {
      fields.show(posing.selected < 0 ? null : posing.session.motion(posing.selected));
      if (figures.hidden !== posing.selected >= 0) figures.hidden = posing.selected >= 0;
      return setText(figures, HELP);
    },
    () => hud.update(),
  );
  posing.onChange = () => {
    follow();
    readout.now();
    pulls.show(posing.mode === "pull");
    if (!posing.isDragging) keepHash(() => poseHash(motions()));
  };
  const start = model.handles.map(({ name }) => options.motions?.get(name));
  if (start.every((motion) => motion !== undefined)) posing.begin(start);
  else posing.onChange();
  stage.beforeFrame = (seconds) => {
    gizmo.color();
    if (posing.isDragging) timeline.play(false);
    timeline.advance(seconds);
    posing.solveWishes();
    posing.advance(seconds);
    polishing?.advance();
    look.legend.look();
    hud.frame(seconds);
    readout.advance();
  };
  stage.restored = () => surfaces[0].refresh();
  stage.afterFrame = () => {
    if (posing.isOnTheWay || polishing?.isOnTheWay || timeline.isPlaying) stage.draw();
  };

  const polish = toggle(
    "Polish",
    "Improves the shape in the full space when a handle is released",
    true,
    (on) => {
      if (polishing) polishing.isOn = on;
      if (!on) hud.assess();
    },
  );
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
    const session = await PosingSession.create(module, better);
    if (stop.signal.aborted) return; // the view was left meanwhile
    newest = better;
    pulling.dispose();
    ghosts.clear();
    const [before] = surfaces;
    surfaces[0] = surfaceOf(better);
    surfaces[0].lookAs(before);
    stage.root.add(surfaces[0].object);
    marks.dispose();
    posing.replace(session, surfaces[0]);
    drag.warmUp();
    marks = new Marks(posing);
    before.object.removeFromParent();
    before.dispose();
    hud.dimension(better.dimension, better.dimension);
    const next = qualityOf(better.dimension);
    quality.replaceWith(next);
    quality = next;
    stage.draw();
  };

  const sheet = shortcutSheet(POSING, (view) => stage.look(1, VIEWS[view]), stop.signal);
  const look = lookSection(stage, surfaces, model, options.up, sheet);
  const bare = () => {
    const { selected } = posing;
    posing.select(-1);
    return () => posing.select(selected);
  };
  const takeAway = new ExportPanel(stage, {
    name: model.name,
    faces: model.faces,
    page: options.page,
    shape: () => carried(posing.surface.shown(), posing.session),
    bare,
  });
  const { panel: timeline, ghosts } = posingTimeline(posing, model.name, () => surfaceOf(newest), bare);
  if (model.timeline !== undefined) timeline.load(model.timeline);
  const panel = [
    section(
      "Handles",
      h("div", { className: "list" }, ...list),
      modes.element,
      figures,
      fields.element,
      pulls.element,
      h("div", { className: "row" }, undo, redo, reset),
      ...chooser(options.choose),
    ),
    quality,
    jigglePanel(
      posing.jiggle,
      () => stage.draw(),
      model.frames && { diagonal: model.diagonal, up: () => stage.up },
    ),
    timeline.element,
    look.element,
    takeAway.element,
  ];
  return {
    hud,
    panel,
    replace,
    get motions() {
      return motions();
    },
    get timeline() {
      return timeline.content;
    },
    script: {
      kind: "posing",
      get session() {
        return posing.session;
      },
      shown: () => carried(posing.surface.shown(), posing.session),
      strains: () => posing.surface.strains(),
      handle: (handle: number) => drag.screen(handle),
      onGpu: surfaces[0].onGpu,
      arrows: gizmo.arrows,
      timeline,
    },
    dispose: () => {
      stop.abort();
      takeAway.dispose();
      pulling.dispose();
      ghosts.clear();
      polishing?.cancel();
      readout.dispose();
      stage.rest();
      look.legend.dispose();
      hud.dispose();
      gizmo.dispose();
      marks.dispose();
      surfaces[0].object.removeFromParent();
      surfaces[0].dispose();
    },
  };
}

function warningOf({ outside, model }: PosingSession): string {
  const parts = outside.map(({ handle, how }) => `${model.handles[handle].name}, ${how}`);
  return parts.length === 0 ? "" : `Beyond what was sampled: ${parts.join("; ")}`;
}

/** Positions after the first handle's motion. */
function carried(shape: Float32Array<ArrayBuffer>, session: PosingSession): Float32Array<ArrayBuffer> {
  const { rotation: R, shift: t } = session.carriedBy;
  for (let i = 0; i < shape.length; i += 3) {
    const [x, y, z] = shape.subarray(i, i + 3);
    for (let a = 0; a < 3; a++) shape[i + a] = R[3 * a] * x + R[3 * a + 1] * y + R[3 * a + 2] * z + t[a];
  }
  return shape;
}
