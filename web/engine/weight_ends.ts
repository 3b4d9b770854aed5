import type { CertainRange } from "./certain_range.ts";
import type { BlendingModel } from "./model.ts";

/** The least and the greatest weight of a pose. */
export type WeightEnds = readonly [number, number];
export const PLAIN_ENDS: WeightEnds = [0, 1];
/** The widest range of sliders, even if minima exist beyond it. */
const WIDEST: WeightEnds = [-1, 2];

/** How far the weight of each of some poses may go while the others of them share the rest evenly: as far as there is
 * certainly a minimum, and where that is not known as far as was sampled. In whole percent, and not beyond `WIDEST`. */
export function weightEnds(
  model: BlendingModel,
  certain: CertainRange | null,
  chosen: readonly number[],
): WeightEnds[] {
  const even = 1 / chosen.length;
  if (chosen.length < 2) return chosen.map(() => PLAIN_ENDS);
  if (!certain) {
    const least = Math.max(WIDEST[0], model.lowestWeight);
    const greatest = Math.min(WIDEST[1], 1 - (chosen.length - 1) * model.lowestWeight);
    return chosen.map(() => [inward(least, Math.ceil), inward(greatest, Math.floor)]);
  }
  const start = model.poses.map((_, pose) => (chosen.includes(pose) ? even : 0));
  return chosen.map((pose) => {
    const step = start.map((w, k) => (k === pose ? 1 - even : -w));
    const back = step.map((x) => -x);
    const least = even - (1 - even) * certain.reach(start, back, (even - WIDEST[0]) / (1 - even));
    const greatest = even + (1 - even) * certain.reach(start, step, (WIDEST[1] - even) / (1 - even));
    return [inward(least, Math.ceil), inward(greatest, Math.floor)];
  });
}

/** A weight in whole percent; what rounding added to such a number does not count. */
function inward(weight: number, round: (percent: number) => number): number {
  return round(Number((100 * weight).toFixed(6))) / 100 || 0;
}
