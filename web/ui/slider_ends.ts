import { PLAIN_ENDS, type WeightEnds } from "../engine/index.ts";
import { h, mark, setText } from "./dom.ts";

/** Labels below a weight's slider where it ends, unless that is 0 and 100 %. */
export function sliderEnds(input: HTMLInputElement) {
  const ends = [h("span"), h("span")];
  const element = h("span", { className: "ends", hidden: true }, ...ends);
  const set = (limits: WeightEnds) => {
    mark(input, "min", limits[0]);
    mark(input, "max", limits[1]);
    ends.forEach((end, i) => setText(end, `${Math.round(100 * limits[i])} %`));
    element.hidden = limits.every((limit, i) => limit === PLAIN_ENDS[i]);
  };
  return { element, set };
}
