import { normalised, withWeight } from "./barycentric.ts";

/** The most poses of a blend: the corners of a larger polygon are too close together to tell apart. */
export const MOST_CHOSEN = 8;
const AT_FIRST = 3;

/** The few poses that take part in a blend, in the order in which they were chosen, and a weight for each. All others
 * have weight zero, and keep it: whatever is changed here changes no weight but those of the chosen. */
export interface PoseChoice {
  readonly poses: readonly number[];
  /** Their sum is one. */
  readonly weights: readonly number[];
}

/** Equal weights of all poses, or of the first ones if there are many. */
export function firstChoice(count: number): PoseChoice {
  const taken = count > MOST_CHOSEN ? AT_FIRST : count;
  return inEqualParts(Array.from({ length: taken }, (_, pose) => pose));
}

/** Poses by name, with weights that are given; null unless they are poses, few enough, and the weights sum to one. */
export function givenChoice(
  poses: readonly string[],
  given: { readonly names: readonly string[]; readonly weights: readonly number[] } | undefined,
): PoseChoice | null {
  if (!given || given.names.length === 0) return null;
  const taken = given.names.map((name) => poses.indexOf(name));
  const isMany = poses.length > MOST_CHOSEN;
  const isWhole = isMany || (taken.every((pose, place) => pose === place) && taken.length === poses.length);
  const isPossible =
    taken.length <= MOST_CHOSEN && new Set(taken).size === taken.length && !taken.includes(-1);
  const sum = given.weights.reduce((total, weight) => total + weight, 0);
  if (!isWhole || !isPossible || Math.abs(sum - 1) > 1e-3) return null;
  return { poses: taken, weights: given.weights.map((weight) => weight / sum) };
}

/** The choice for one weight per pose: of many poses those that have one. */
export function choiceOfWeights(weights: readonly number[]): PoseChoice {
  const all = weights.map((_, pose) => pose);
  const poses =
    all.length > MOST_CHOSEN ? all.filter((pose) => weights[pose] !== 0).slice(0, MOST_CHOSEN) : all;
  return { poses, weights: poses.map((pose) => weights[pose]) };
}

export function inEqualParts(poses: readonly number[]): PoseChoice {
  return { poses, weights: poses.map(() => 1 / poses.length) };
}

/** Adds a pose, the last one, with weight zero: the shape stays. The same choice if it is full or has the pose. */
export function withPose(choice: PoseChoice, pose: number): PoseChoice {
  if (choice.poses.includes(pose) || choice.poses.length >= MOST_CHOSEN) return choice;
  return { poses: [...choice.poses, pose], weights: [...choice.weights, 0] };
}

/** Removes a pose; the others share its weight in their proportions. The same choice if it is the only one. */
export function withoutPose(choice: PoseChoice, pose: number): PoseChoice {
  const place = choice.poses.indexOf(pose);
  if (place < 0 || choice.poses.length === 1) return choice;
  const { weights } = reweighted(choice, place, 0);
  const others = <T>(values: readonly T[]) => values.filter((_, i) => i !== place);
  return { poses: others(choice.poses), weights: normalised(others(weights)) };
}

/** Sets the weight of the pose at a place of the choice; the others share the rest in their proportions. */
export function reweighted(choice: PoseChoice, place: number, weight: number): PoseChoice {
  if (choice.poses.length === 1) return { ...choice, weights: [1] };
  return { ...choice, weights: withWeight(choice.weights, place, weight) };
}

/** Without negative weights, and in the proportions of the others. */
export function withoutNegatives(choice: PoseChoice): PoseChoice {
  return { ...choice, weights: normalised(choice.weights.map((w) => Math.max(w, 0))) };
}

/** One weight for each of `count` poses. */
export function allWeights(choice: PoseChoice, count: number): number[] {
  const all = Array<number>(count).fill(0);
  choice.poses.forEach((pose, place) => (all[pose] = choice.weights[place]));
  return all;
}
