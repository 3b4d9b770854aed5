import type { Motion } from "../engine/index.ts";
import type { Pulled } from "./pulling.ts";

/** What continues when a better model replaces the present one. */
export interface Continued {
  /** The present motions of its handles. */
  readonly motions: readonly Motion[];
  /** Its motions for those of the model before. */
  all(motions: readonly Motion[]): readonly Motion[];
  /** What pulls on its points. */
  readonly pulled: Pulled | null;
}
