import { h, section, slider, toggle } from "./dom.ts";
import type { Jiggle } from "./jiggle.ts";
import type { Axis } from "./stage.ts";

/** The switch of the swing, and its settings while it is on. Gravity is in diagonals of the body per square second;
 * `turn` lets it pull down again after another axis points up. */
export function jigglePanel(
  jiggle: Jiggle,
  draw: () => void,
  gravity: { readonly diagonal: number; readonly up: () => Axis } | null,
): { element: HTMLElement; turn(): void } {
  const change = (act: () => void) => {
    act();
    jiggle.wake();
    draw();
  };
  const set = (part: Partial<Jiggle["dynamics"]>) =>
    change(() => (jiggle.dynamics = { ...jiggle.dynamics, ...part }));
  const { frequency, damping } = jiggle.dynamics;
  const settings = h(
    "div",
    { hidden: true },
    slider(
      "Frequency",
      { min: 0.5, max: 6, step: 0.1, value: frequency },
      (hertz) => `${hertz.toFixed(1)} Hz`,
      (hertz) => set({ frequency: hertz }),
    ).element,
    slider(
      "Damping",
      { min: 0, max: 0.5, step: 0.01, value: damping },
      (share) => `${Math.round(100 * share)} %`,
      (share) => set({ damping: share }),
    ).element,
  );
  let strength = 0;
  const fall = () => {
    if (!gravity) return;
    const size = -strength * gravity.diagonal;
    const [x, y, z] = ["x", "y", "z"].map((axis) => (axis === gravity.up() ? size : 0));
    set({ gravity: [x, y, z] });
  };
  if (gravity) {
    const pull = (diagonals: number) => {
      strength = diagonals;
      fall();
    };
    const range = { min: 0, max: 3, step: 0.1, value: 0 };
    settings.append(
      slider("Gravity", range, (diagonals) => `${diagonals.toFixed(1)} diagonals/s²`, pull).element,
    );
  }
  const button = toggle("Jiggle", "The body swings after its handles; J", jiggle.isOn, (on) => {
    settings.hidden = !on;
    change(() => (jiggle.isOn = on));
  });
  button.id = "jiggle";
  const element = section("Motion", h("div", { className: "row" }, button), settings);
  return { element, turn: () => strength > 0 && fall() };
}
