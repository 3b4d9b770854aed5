import { enable, h, setText, toggle } from "./dom.ts";
import type { Improving } from "./improving.ts";
import type { Pulling } from "./pulling.ts";

/** The controls of pulled points, shown in the mode *Pull* and while points are kept. `improving` makes handles of kept
 * points, or is a text that says why nothing does; `onKept` is called after points were kept or let go. */
export function pullRow(
  pulling: Pulling,
  improving: Improving | string = "",
  onKept: () => void = () => {},
): { element: HTMLElement; show(isPulling: boolean): void } {
  const keep = toggle("Keep points", "Points stay where they are pulled to, like handles", false, (on) => {
    pulling.keeps = on;
  });
  const letGo = h("button", { type: "button", onclick: () => pulling.letGo() }, "Let go");
  const hint = h("p", { className: "hint" }, "Press any point of the surface and pull.");
  const told = h("p", { className: "hint", role: "status" });
  const queue = typeof improving === "string" ? null : improving;
  const again = h("button", { type: "button", onclick: () => queue?.retry() }, "Make handles");
  again.title = "Computes a model that has the kept points as handles";
  const element = h("div", { hidden: true }, hint, h("div", { className: "row" }, keep, letGo), told, again);
  let isPulling = false;
  const show = () => {
    const { length } = pulling.kept;
    element.hidden = !isPulling && length === 0;
    enable(letGo, length > 0);
    const text = queue ? queue.text : length > 0 ? String(improving) : "";
    setText(told, text);
    told.hidden = text === "";
    again.hidden = !queue?.canRetry;
  };
  if (queue) queue.onChange = show;
  pulling.onChange = () => {
    show();
    const points = pulling.kept.map(({ name, corners, shares: [a, b, c], reach }) => ({
      ...{ name, corners, reach },
      shares: [a, b, c] as const,
    }));
    queue?.keep(points);
    onKept();
  };
  return {
    element,
    show: (now) => {
      isPulling = now;
      show();
    },
  };
}
