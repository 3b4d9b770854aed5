import { BlendingSession, type BlendingModel } from "../engine/index.ts";
import { withWeight } from "../ui/barycentric.ts";
import { slider } from "../ui/dom.ts";
import { CLAY } from "../ui/handle_colors.ts";
import { weightStates } from "../ui/key_states.ts";
import { OwnLook } from "../ui/own_look.ts";
import { showMaterial } from "../ui/show_material.ts";
import type { Stage } from "../ui/stage.ts";
import { Surface } from "../ui/surface.ts";
import { playButton } from "./play_button.ts";
import { Playing } from "./playing.ts";
import { indexOf, type ShownModel } from "./shown_model.ts";

/** Weights may differ from a sum of one by this much. */
const SUM_ERROR = 1e-6;

/** A model of poses. */
export async function shownBlending(
  stage: Stage,
  module: WebAssembly.Module,
  model: BlendingModel,
): Promise<ShownModel> {
  const session = await BlendingSession.create(module, model);
  const { poses } = model;
  const own = OwnLook.of(model.appearance, stage.renderer.graphics);
  const surface = new Surface(
    stage.renderer.graphics,
    model.space,
    model.faces,
    model.diagonal,
    false,
    null,
    own,
  );
  void showMaterial(stage, [surface]);
  surface.occluded = true;
  surface.paint(() => CLAY);
  stage.root.add(surface.object);
  const equal = poses.map(() => 1 / poses.length);
  let [wish, solved]: [readonly number[], readonly number[] | null] = [equal, null];
  const ask = (weights: readonly number[]) => {
    wish = weights;
    stage.draw();
  };
  const playing = new Playing<readonly number[]>(model.timeline, weightStates(poses), ask);
  let update = () => {};
  const solve = () => {
    if (solved === wish) return;
    solved = wish;
    const { milliseconds } = session.blend([...wish]);
    surface.show(session.q);
    shown.onSolved({ weights: shown.weights, milliseconds });
    update();
  };
  const bar = () => {
    const sliders = poses.map((name, pose) =>
      slider(name, { min: 0, max: 1, step: 0.001, value: wish[pose] }, percent, (weight) => {
        playing.isOn = false;
        ask(poses.length === 1 ? [1] : withWeight(wish, pose, weight));
      }),
    );
    const play = playButton(playing, shown.play);
    update = () => {
      sliders.forEach(({ input, set }, pose) => {
        if (input.valueAsNumber !== wish[pose]) set(wish[pose]);
      });
      play.update();
    };
    return [...sliders.map(({ element }) => element), ...play.elements];
  };
  const named = (weights: readonly number[]) =>
    Object.fromEntries(poses.map((name, pose) => [name, weights[pose]]));
  stage.beforeFrame = (seconds) => {
    playing.advance(seconds);
    solve();
  };
  stage.afterFrame = () => {
    if (playing.isOn) stage.draw();
    else update();
  };
  stage.restored = () => surface.refresh();
  const shown: ShownModel = {
    info: {
      kind: "interpolation",
      name: model.name,
      handles: [],
      poses,
      dimension: model.dimension,
      vertices: model.space.vertices,
    },
    faces: model.faces,
    onSolved: () => {},
    handles: {},
    get weights() {
      return named(wish);
    },
    setHandles: () => {
      throw new Error("The model has poses, no handles.");
    },
    setWeights: (weights) => {
      const all = asked(poses, weights);
      playing.isOn = false;
      ask(all);
    },
    reset: () => {
      playing.isOn = false;
      ask(equal);
    },
    play: (on) => {
      playing.isOn = on;
      stage.draw();
    },
    get isPlaying() {
      return playing.isOn;
    },
    shape: () => {
      solve();
      return surface.shown();
    },
    controls: bar,
    key: () => {},
    bare: () => () => {},
    dispose: () => {
      stage.rest();
      surface.object.removeFromParent();
      surface.dispose();
      own?.dispose();
    },
  };
  solve();
  return shown;
}

function asked(poses: readonly string[], weights: Readonly<Record<string, number>>): number[] {
  const all = poses.map(() => 0);
  for (const [name, weight] of Object.entries(weights)) all[indexOf(poses, name, "pose")] = weight;
  const sum = all.reduce((total, weight) => total + weight, 0);
  if (!(Math.abs(sum - 1) <= SUM_ERROR)) throw new Error(`The weights sum to ${sum}, but must sum to 1.`);
  return all;
}

const percent = (weight: number) => `${(100 * weight).toFixed(0)} %`;
