import type { CertainRange } from "./certain_range.ts";
import type { BlendingModel } from "./model.ts";

/** The smallest and the largest weight of a pose. */
export type WeightEnds = readonly [number, number];
export const PLAIN_ENDS: WeightEnds = [0, 1];
/** The widest range of sliders, even if minima exist beyond it. */
const WIDEST: WeightEnds = [-1, 2];

/** How far the weight of one of some poses may go while the others share the rest evenly: as far as a minimum certainly
 * exists or, where that is not known, as far as was sampled. In whole percent, and not beyond `WIDEST`. */
export function weightEnds(
  model: BlendingModel,
  certain: CertainRange | null,
  chosen: readonly number[],
  pose: number,
): WeightEnds {
  if (chosen.length < 2) return PLAIN_ENDS;
  const others = chosen.length - 1;
  const sampled = (weight: number) => Math.min(weight, (1 - weight) / others) > model.lowestWeight - 1e-9;
  const holds = (percent: number) => {
    const weight = percent / 100;
    if (!certain) return sampled(weight);
    return certain.holds(
      model.poses.map((_, k) => (k === pose ? weight : chosen.includes(k) ? (1 - weight) / others : 0)),
    );
  };
  const [least, greatest] = PLAIN_ENDS.map((end, i) => farthest(holds, 100 * end, 100 * WIDEST[i]) / 100);
  return [least, greatest];
}

/** The farthest whole number from one that holds towards another, if they hold up to there. */
function farthest(holds: (number: number) => boolean, from: number, to: number): number {
  if (holds(to)) return to;
  let [within, beyond] = [from, to];
  while (Math.abs(beyond - within) > 1) {
    const middle = Math.trunc((within + beyond) / 2);
    if (holds(middle)) within = middle;
    else beyond = middle;
  }
  return within;
}
