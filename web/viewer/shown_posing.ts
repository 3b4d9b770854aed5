import { eulerOfRotation, rotationOfEuler, type Motion, type PosingModel } from "../engine/index.ts";
import { choice, h, mark } from "../ui/dom.ts";
import { handleButtons } from "../ui/handle_buttons.ts";
import { handleStates } from "../ui/key_states.ts";
import type { Mode } from "../ui/posing.ts";
import { actOn } from "../ui/posing_keys.ts";
import { PosingScene, shownShape } from "../ui/posing_scene.ts";
import { showMaterial } from "../ui/show_material.ts";
import type { Stage } from "../ui/stage.ts";
import { Playing } from "./playing.ts";
import { playButton } from "./play_button.ts";
import type { HandleMotion, ModelInfo } from "./public.ts";
import { indexOf, vector, type ShownModel } from "./shown_model.ts";

const DEGREES = 180 / Math.PI;

/** A model of handles. */
export async function shownPosing(
  stage: Stage,
  module: WebAssembly.Module,
  model: PosingModel,
): Promise<ShownModel> {
  const scene = await PosingScene.create(stage, module, model);
  const { posing } = scene;
  void showMaterial(stage, scene.surfaces);
  scene.surfaces[0].occluded = true;
  const names = model.handles.map(({ name }) => name);
  const playing = new Playing<readonly Motion[]>(model.timeline, handleStates(names), (motions) =>
    motions.forEach((motion, handle) => posing.wish(handle, motion)),
  );
  const info: ModelInfo = {
    kind: "posing",
    name: model.name,
    handles: names,
    poses: [],
    dimension: model.dimension,
    vertices: model.space.vertices,
  };
  const bar = () => {
    const buttons = handleButtons(posing);
    const modes = choice<Mode>(
      "What a drag does",
      [
        ["move", "Move"],
        ["turn", "Turn"],
      ],
      posing.mode,
      (mode) => posing.setMode(mode),
    );
    const play = playButton(playing, shown.play);
    const reset = h("button", { type: "button", onclick: shown.reset }, "Reset");
    update = () => {
      buttons.forEach((button, handle) => mark(button, "aria-pressed", handle === posing.selected));
      modes.set(posing.mode);
      play.update();
    };
    return [...buttons, modes.element, ...play.elements, reset];
  };
  let update = () => {};
  posing.onChange = () => {
    scene.follow();
    scene.gizmo.update();
    update();
  };
  posing.beforeEdit = () => (playing.isOn = false);
  posing.onSolved = ({ milliseconds }) => {
    scene.follow();
    shown.onSolved({ handles: shown.handles, milliseconds });
  };
  stage.beforeFrame = (seconds) => {
    if (posing.isDragging) playing.isOn = false;
    playing.advance(seconds);
    posing.solveWishes();
    posing.advance(seconds);
    scene.gizmo.update();
    update();
  };
  stage.afterFrame = () => {
    if (posing.isOnTheWay || playing.isOn) stage.draw();
  };
  stage.restored = () => posing.surface.refresh();
  const shown: ShownModel = {
    info,
    faces: model.faces,
    onSolved: () => {},
    get handles() {
      return Object.fromEntries(names.map((name, handle) => [name, given(posing.motion(handle))]));
    },
    weights: {},
    setHandles: (motions) => {
      const asked = Object.entries(motions).map(
        ([name, motion]) => [indexOf(names, name, "handle"), motionOf(motion)] as const,
      );
      playing.isOn = false;
      for (const [handle, motion] of asked) posing.wish(handle, motion);
    },
    setWeights: () => {
      throw new Error("The model has handles, no poses.");
    },
    reset: () => posing.reset(),
    play: (on) => {
      playing.isOn = on;
      if (!on) posing.commit();
      stage.draw();
    },
    get isPlaying() {
      return playing.isOn;
    },
    shape: () => {
      posing.solveWishes();
      return shownShape(posing);
    },
    controls: bar,
    key: (event) => actOn(event, posing, () => {}),
    bare: () => {
      const { selected } = posing;
      posing.select(-1);
      return () => posing.select(selected);
    },
    dispose: () => {
      stage.rest();
      scene.dispose();
    },
  };
  posing.onChange();
  return shown;
}

function given({ rotation, translation }: Motion): Required<HandleMotion> {
  const [a, b, c] = eulerOfRotation(rotation);
  return { degrees: [DEGREES * a, DEGREES * b, DEGREES * c], translation };
}

function motionOf({ degrees, translation }: HandleMotion): Motion {
  const [a, b, c] = vector(degrees, "Degrees");
  return {
    rotation: rotationOfEuler([a / DEGREES, b / DEGREES, c / DEGREES]),
    translation: vector(translation, "A translation"),
  };
}
