import type { HandleMotion, ModelInfo, SolvedDetail } from "./public.ts";

/** A model on the stage of the component. */
export interface ShownModel {
  readonly info: ModelInfo;
  readonly handles: Record<string, Required<HandleMotion>>;
  readonly weights: Record<string, number>;
  /** Called after each solve. */
  onSolved: (detail: SolvedDetail) => void;
  setHandles(motions: Readonly<Record<string, HandleMotion>>): void;
  setWeights(weights: Readonly<Record<string, number>>): void;
  reset(): void;
  play(on: boolean): void;
  readonly isPlaying: boolean;
  shape(): Float32Array;
  readonly faces: Uint32Array;
  /** What is in the bar; made on first use. */
  controls(): HTMLElement[];
  key(event: KeyboardEvent): void;
  /** Hides what is no part of the shape; the result shows it again. */
  bare(): () => void;
  dispose(): void;
}

/** A name's index. Throws an Error for a name that the model lacks. */
export function indexOf(names: readonly string[], name: string, what: "handle" | "pose"): number {
  const index = names.indexOf(name);
  if (index < 0) throw new Error(`The model has no ${what} '${name}', but ${names.join(", ")}.`);
  return index;
}

/** Three finite numbers; zeros where they are missing. */
export function vector(value: readonly number[] | undefined, what: string): [number, number, number] {
  const [x, y, z, ...more] = value ?? [0, 0, 0];
  if (![x, y, z].every(Number.isFinite) || more.length > 0)
    throw new Error(`${what} must be three finite numbers, not [${String(value)}].`);
  return [x, y, z];
}
