import { enable, h, toggle } from "./dom.ts";
import type { Pulling } from "./pulling.ts";

/** The controls of pulled points, shown in the mode *Pull* and while points are kept. */
export function pullRow(pulling: Pulling): { element: HTMLElement; show(isPulling: boolean): void } {
  const keep = toggle("Keep points", "Points stay where they are pulled to, like handles", false, (on) => {
    pulling.keeps = on;
  });
  const letGo = h("button", { type: "button", onclick: () => pulling.letGo() }, "Let go");
  const hint = h("p", { className: "hint" }, "Press any point of the surface and pull.");
  const element = h("div", { hidden: true }, hint, h("div", { className: "row" }, keep, letGo));
  let isPulling = false;
  const show = () => {
    element.hidden = !isPulling && pulling.kept === 0;
    enable(letGo, pulling.kept > 0);
  };
  pulling.onChange = show;
  return {
    element,
    show: (now) => {
      isPulling = now;
      show();
    },
  };
}
