import type { Motion } from "../engine/index.ts";
import type { Hud } from "./hud.ts";
import type { Improving } from "./improving.ts";
import type { Polish } from "./polishing.ts";
import type { Axis } from "./stage.ts";

/** What is on the stage and in the panel for one model. */
export interface View {
  readonly hud: Pick<Hud, "element" | "notice">;
  readonly panel: HTMLElement[];
  /** What the stage shows and which keys it takes, for screen readers. */
  readonly label: string;
  /** For scripts and tests, as `window.snapspace`. */
  readonly script: Record<string, unknown>;
  /** From where another view of the same model continues; missing in views without a model. */
  readonly state?: ViewState;
  dispose(): void;
}

/** Motions of handles by name. */
export type Motions = ReadonlyMap<string, Motion>;

export interface ViewOptions {
  readonly up: Axis;
  readonly forceCpu: boolean;
  /** Leaves the camera and the stage as they are. */
  readonly keepView?: boolean;
  /** The first motions of the handles; those that are not among them are at rest. */
  readonly motions?: Motions;
  /** Poses that take part at first, by name, and their weights; if the model has them all. */
  readonly blend?: { readonly names: readonly string[]; readonly weights: readonly number[] };
  /** Goes to the view in which handles are chosen on the model's body; missing without a server. */
  readonly choose?: () => void;
  /** Whether a file was opened in the page of another model: the address stays that of the page's own model. */
  readonly isFromFile?: boolean;
  /** Gives the user a page in one file with the model and the content of a timeline; missing without a server. */
  readonly page?: (timeline: string | null) => Promise<void>;
  /** Content of a timeline file, in place of that of the model. */
  readonly timeline?: string | null;
  /** Improves the model for points that are kept, or why that is not possible; missing without a server. */
  readonly improving?: Improving | string;
  /** Improves frames when a handle is let go. */
  readonly polish?: Polish;
}

/** What a view of a model begins with. */
export type ViewState = Pick<ViewOptions, "motions" | "blend" | "timeline">;
