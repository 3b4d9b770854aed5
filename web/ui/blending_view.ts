import { Vector3 } from "three";

import { BlendingSession, type BlendingModel, type FrameReport } from "../engine/index.ts";
import { IDENTITY } from "../engine/motion.ts";
import { blendPanel } from "./blend_panel.ts";
import { BlendPath, type Jump } from "./blend_path.ts";
import { listenToBlendingKeys } from "./blending_keys.ts";
import { blendHash, keepHashSoon, KeptKeys } from "./address.ts";
import { chooser, enable, h, mark, section, toggle } from "./dom.ts";
import { CLAY } from "./handle_colors.ts";
import { ExportPanel } from "./export_panel.ts";
import { Ghosts } from "./ghosts.ts";
import { Hud } from "./hud.ts";
import { Jiggle } from "./jiggle.ts";
import { jigglePanel } from "./jiggle_panel.ts";
import { weightStates } from "./key_states.ts";
import { lookSection, qualitySection } from "./look_panel.ts";
import {
  allWeights,
  choiceOfWeights,
  firstChoice,
  givenChoice,
  inEqualParts,
  withoutNegatives,
  type PoseChoice,
} from "./pose_choice.ts";
import { OwnLook } from "./own_look.ts";
import { posesOf } from "./poses_of.ts";
import { Readout } from "./readout.ts";
import { BLENDING, shortcutSheet } from "./shortcuts.ts";
import { VIEWS, type Stage } from "./stage.ts";
import { Surface } from "./surface.ts";
import { label } from "./surface_labels.ts";
import { thumbnail } from "./thumbnail.ts";
import { TimelinePanel } from "./timeline_panel.ts";
import type { View, ViewOptions } from "./view.ts";

/** Blending: a shape between poses, and beside it the straight blend if that is asked for. */
export async function blendingView(
  stage: Stage,
  module: WebAssembly.Module,
  model: BlendingModel,
  options: ViewOptions,
): Promise<View> {
  const session = await BlendingSession.create(module, model);
  const rests = posesOf(model);
  const own = OwnLook.of(model.appearance, stage.renderer.graphics);
  const make = (space: BlendingModel["space"]) =>
    new Surface(stage.renderer.graphics, space, model.faces, model.diagonal, options.forceCpu, rests, own);
  const [elastic, straight] = [make(model.space), make(model.poseSpace)];
  for (const surface of [elastic, straight]) {
    surface.paint(() => CLAY);
    stage.root.add(surface.object);
  }
  straight.object.visible = false;
  stage.place(model.space.base, options.up);

  const hud = new Hud(
    model.name,
    `${model.poses.length} poses, ${model.space.vertices.toLocaleString("en")} surface vertices`,
    () => session,
  );
  hud.dimension(model.dimension, model.dimension);
  const readout = new Readout(() => hud.update());
  const names = [h("span", { className: "tag" }, "elastic"), h("span", { className: "tag" }, "straight")];
  const path = new BlendPath(session);
  let [choice, compared] = [
    givenChoice(model.poses, options.blend) ?? firstChoice(model.poses.length),
    false,
  ];
  let solved: number[] | null = null;

  /** Play and the timeline both set the weights: where one begins, the other ends. */
  const stopWalking = () => {
    path.play(false);
    mark(play, "aria-pressed", false);
  };
  const ask = (asked: PoseChoice) => {
    stopWalking();
    timeline.play(false);
    hud.remark("");
    choice = asked;
    showChoice(); // the next click may come before the next picture
    keep();
    stage.draw();
  };
  const blend = () => ({ names: choice.poses.map((pose) => model.poses[pose]), weights: choice.weights });
  const hash = () => blendHash(blend());
  const keep = () => {
    if (!options.isFromFile) keepHashSoon(hash);
  };
  const play = toggle("Play", "Space", false, (on) => {
    if (on) timeline.play(false);
    path.play(on);
    if (!on) keep();
    hud.remark("");
    stage.draw();
  });
  const compare = toggle("Compare", "The straight blend of the poses beside it", false, (on) => {
    compared = on;
    place();
  });
  const mean = h("button", { type: "button", onclick: () => ask(inEqualParts(choice.poses)) }, "Mean");
  const beyond = toggle("Beyond", "Weights below 0 and above 100 %", false, (on) => {
    panel.extend(on ? endsOf : null);
    if (!on && choice.weights.some((w) => w < 0)) ask(withoutNegatives(choice));
  });
  const endsOf = (poses: readonly number[], pose: number) => session.ends(poses, pose);
  const first = firstChoice(model.poses.length).poses;
  const canGoBeyond = first.some((pose) => endsOf(first, pose)[0] < 0);
  const buttons = [play, compare, mean, ...(canGoBeyond ? [beyond] : [])];
  const panel = blendPanel(model.poses, buttons, ask);

  const place = () => {
    straight.object.visible = compared;
    stage.look(compared ? 1.9 : 1);
    const right = new Vector3(1, 0, 0).applyQuaternion(stage.camera.quaternion);
    right.setY(0).normalize();
    const apart = right
      .applyQuaternion(stage.root.quaternion.clone().invert())
      .multiplyScalar(0.45 / stage.root.scale.x);
    const side = compared ? 1 : 0;
    elastic.object.matrix.makeTranslation(apart.clone().multiplyScalar(-side));
    straight.object.matrix.makeTranslation(apart.clone().multiplyScalar(side));
    for (const surface of [elastic, straight]) surface.object.matrixWorldNeedsUpdate = true;
    stage.root.updateMatrixWorld();
    timeline.skin();
  };
  const jiggle = new Jiggle({
    step: (dt, dynamics) => {
      session.time.dynamics = dynamics;
      return session.step(dt, allWeights(choice, model.poses.length));
    },
    settle: () => session.blend(allWeights(choice, model.poses.length)),
    speed: () => session.speed,
  });
  const solve = (seconds: number) => {
    const wish = allWeights(choice, model.poses.length);
    const isNew = !solved || solved.some((w, i) => w !== wish[i]);
    if (isNew && jiggle.isOn && wish.every((w) => w >= 0)) jiggle.wake();
    else if (isNew) take(session.blend(wish));
    const report = jiggle.advance(seconds);
    if (report) take(report);
  };
  const showChoice = () => {
    panel.show(choice);
    enable(play, choice.poses.length > 1);
  };
  /** Shows the session's shape. */
  const take = (report: FrameReport) => {
    solved = allWeights(choice, model.poses.length);
    hud.solved(report);
    hud.warn(warningOf(session, report));
    for (const surface of [elastic, straight]) surface.weights = solved;
    elastic.show(session.q);
    straight.show(solved);
  };
  const walk = (seconds: number) => {
    const step = path.advance(choice, seconds);
    choice = step.choice;
    showChoice();
    take(step.report);
    if (step.jump) hud.remark(jumpRemark(model.poses, step.jump));
  };
  const stop = new AbortController();
  const sheet = shortcutSheet(BLENDING, (view) => stage.look(compared ? 1.9 : 1, VIEWS[view]), stop.signal);
  const look = lookSection(stage, [elastic, straight], model, options.up, sheet);
  const ghosts = new Ghosts(stage, () => make(model.space));
  const timeline = new TimelinePanel<readonly number[]>(stage, {
    name: model.name,
    kept: options.isFromFile ? null : new KeptKeys(`blending ${model.name}`),
    states: weightStates(model.poses),
    state: () => allWeights(choice, model.poses.length),
    show: (weights) => {
      stopWalking();
      choice = choiceOfWeights(weights);
      showChoice();
      stage.draw();
    },
    settle: keep,
    surface: elastic,
    shapes: (states) => {
      const { x, y, z } = new Vector3().setFromMatrixPosition(elastic.object.matrix);
      const carriedBy = { ...IDENTITY, shift: [x, y, z] as const };
      return session.shapesAt(states).map((coefficients) => ({ coefficients, carriedBy }));
    },
    ghosts,
    bare: () => () => {},
  });
  const takeAway = new ExportPanel(stage, {
    name: model.name,
    faces: model.faces,
    isFromFile: options.isFromFile,
    page: options.page && (() => options.page!(timeline.content)),
    shape: () => elastic.shown(),
    bare: () => () => {},
  });
  timeline.begin(options.timeline, model.timeline);
  stage.beforeFrame = (seconds) => {
    timeline.advance(seconds);
    if (path.playing) walk(seconds);
    else solve(seconds);
    look.legend.look();
    hud.frame(seconds);
    readout.ask();
    readout.advance();
    label(stage, names, [elastic, straight], compared);
  };
  stage.restored = () => {
    for (const surface of [elastic, straight]) surface.refresh();
    ghosts.refresh();
  };
  stage.afterFrame = () => {
    if (path.playing || jiggle.moves || timeline.isPlaying) stage.draw();
  };
  listenToBlendingKeys(play, panel.search, stop.signal);
  stage.renderer.canvas.parentElement!.append(...names);
  showChoice();
  if (canGoBeyond && choice.weights.some((w) => w < 0)) beyond.click();
  solve(0);
  const illustrate = (pose: number) => {
    if (pose === model.poses.length || stop.signal.aborted) return;
    const alone = model.poses.map((_, k) => (k === pose ? 1 : 0));
    panel.illustrate(pose, thumbnail(stage, straight, elastic, alone));
    straight.show(solved!);
    stage.renderer.render(stage.scene, stage.camera);
    setTimeout(illustrate, 0, pose + 1);
  };
  setTimeout(illustrate, 60, 0); // after the first picture, one by one

  return {
    hud,
    label: "The shape. Keys: Space walks through the poses, K adds a key, P plays the keys.",
    panel: [
      ...panel.sections,
      qualitySection(model.dimension, (d) => {
        session.dimension = d;
        solved = null;
        path.restart();
        hud.dimension(d, model.dimension);
        stage.draw();
      }),
      jigglePanel(jiggle, () => stage.draw(), null).element,
      timeline.element,
      look.element,
      takeAway.element,
      ...(options.choose ? [section("Handles", ...chooser(options.choose))] : []),
    ],
    get state() {
      return { blend: blend(), timeline: timeline.content };
    },
    script: {
      kind: "interpolation",
      session,
      shown: () => elastic.shown(),
      straight: () => straight.shown(),
      strains: () => elastic.strains(),
      onGpu: elastic.onGpu,
      timeline,
    },
    dispose: () => {
      stop.abort();
      takeAway.dispose();
      timeline.dispose();
      stage.rest();
      look.legend.dispose();
      hud.dispose();
      readout.dispose();
      names.forEach((name) => name.remove());
      for (const surface of [elastic, straight]) {
        surface.object.removeFromParent();
        surface.dispose();
      }
      own?.dispose();
    },
  };
}

function jumpRemark(poses: readonly string[], { pose, weight }: Jump): string {
  return `The shape jumps on the way to ${poses[pose]}, at a weight of ${(100 * weight).toFixed(1)} %.`;
}

function warningOf({ outside, certain }: BlendingSession, { status }: FrameReport): string {
  if (status === "unbounded") return "The energy has no minimum this far out; the last shape is shown";
  if (certain === false) return "Too far: the energy may have no minimum";
  return outside.length > 0 ? `Beyond what was sampled: ${outside.join(", ")}` : "";
}
