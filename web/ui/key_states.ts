import { eulerOfRotation, rotationOfEuler, type Motion } from "../engine/index.ts";
import { quaternionOf, rotationOf } from "./rotations.ts";
import type { States } from "./timeline_file.ts";

const DEGREES = 180 / Math.PI;
export const REST: Motion = { rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1], translation: [0, 0, 0] };

/** Motions of handles: centroids move straight, and handles turn about one axis. */
export function handleStates(names: readonly string[]): States<readonly Motion[]> {
  return {
    kind: "posing",
    between: (from, to, share) => from.map((motion, handle) => betweenMotions(motion, to[handle], share)),
    written: (motions) => {
      const entries = names.map((name, handle) => {
        const { rotation, translation } = motions[handle];
        const degrees = eulerOfRotation(rotation).map((angle) => short(DEGREES * angle));
        return [name, { degrees, translation: translation.map(short) }] as const;
      });
      return { handles: Object.fromEntries(entries) };
    },
    read: ({ handles }, before) => {
      const given = entriesOf(handles, names, "handle");
      return names.map((name, handle) => {
        const motion = given.get(name) as Record<string, unknown> | undefined;
        if (!motion) return before?.[handle] ?? REST;
        const [a, b, c] = vector(motion["degrees"] ?? [0, 0, 0]);
        const rotation = rotationOfEuler([a / DEGREES, b / DEGREES, c / DEGREES]);
        return { rotation, translation: vector(motion["translation"] ?? [0, 0, 0]) };
      });
    },
  };
}

/** Weights of all poses. */
export function weightStates(names: readonly string[]): States<readonly number[]> {
  return {
    kind: "interpolation",
    between: (from, to, share) => from.map((weight, pose) => (1 - share) * weight + share * to[pose]),
    written: (weights) => {
      const entries = names.map((name, pose) => [name, weights[pose]] as const);
      return { weights: Object.fromEntries(entries.filter(([, weight]) => weight !== 0)) };
    },
    read: ({ weights }) => {
      const given = entriesOf(weights, names, "pose");
      const read = names.map((name) => Number(given.get(name) ?? 0));
      const sum = read.reduce((total, weight) => total + weight, 0);
      if (!(Math.abs(sum - 1) < 1e-6)) throw new Error("The weights of a key must sum to one.");
      return read;
    },
  };
}

function betweenMotions(from: Motion, to: Motion, share: number): Motion {
  if (share === 0) return from;
  const turn = quaternionOf(from.rotation).slerp(quaternionOf(to.rotation), share);
  const [x, y, z] = from.translation.map((t, axis) => t + share * (to.translation[axis] - t));
  return { rotation: rotationOf(turn), translation: [x, y, z] };
}

function entriesOf(value: unknown, names: readonly string[], what: string): Map<string, unknown> {
  if (typeof value !== "object" || value === null) throw new Error(`A key has no ${what}s.`);
  const entries = Object.entries(value);
  const unknown = entries.find(([name]) => !names.includes(name));
  if (unknown) throw new Error(`The timeline has a ${what} '${unknown[0]}', which the model lacks.`);
  return new Map(entries);
}

function vector(value: unknown): [number, number, number] {
  if (!Array.isArray(value) || value.length !== 3 || !value.every((x) => Number.isFinite(x)))
    throw new Error("A motion in the timeline needs three degrees and three lengths.");
  const [x, y, z] = value as number[];
  return [x, y, z];
}

const short = (x: number) => Number(x.toPrecision(9)) || 0;
