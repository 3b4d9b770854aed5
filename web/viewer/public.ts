/** The types of the component's interface. They import nothing, so that they are the package's declarations as they are. */

/** A motion of a handle from rest: Euler angles in degrees (R = Rz Ry Rx, about the handle's centroid), and a translation
 * in the mesh's length unit. What is missing is zero. */
export interface HandleMotion {
  degrees?: readonly [number, number, number];
  translation?: readonly [number, number, number];
}

/** What a loaded model can do. */
export interface ModelInfo {
  kind: "posing" | "interpolation";
  name: string;
  /** Names of the handles; empty for a model of poses. */
  handles: readonly string[];
  /** Names of the poses; empty for a model of handles. */
  poses: readonly string[];
  /** Number of reduced coordinates. */
  dimension: number;
  /** Vertices of the surface. */
  vertices: number;
}

/** After each solve: where the handles are, or the weights of the poses. */
export interface SolvedDetail {
  handles?: Record<string, Required<HandleMotion>>;
  weights?: Record<string, number>;
  /** Milliseconds of the solve. */
  milliseconds: number;
}

export interface SnapspaceViewerEventMap {
  load: CustomEvent<ModelInfo>;
  solve: CustomEvent<SolvedDetail>;
  error: CustomEvent<{ message: string }>;
}

/** <snapspace-viewer src="dragon.snapspace" poster="dragon.png" controls></snapspace-viewer> */
export interface SnapspaceViewerElement extends HTMLElement {
  /** The address of a .snapspace file; other sites must allow it (CORS). */
  src: string;
  /** A picture that is shown until the model is. */
  poster: string;
  /** Whether there is a bar with handles or weights; otherwise there is only the shape. */
  controls: boolean;
  /** The axis that points up: "x", "y" or "z"; "" takes the file's, or z. */
  up: string;
  /** Null until a model is shown. */
  readonly model: ModelInfo | null;

  /** Shows a model from bytes in place of `src`. Rejects with an Error if they are no model. */
  load(bytes: ArrayBuffer, name?: string): Promise<ModelInfo>;
  /** Moves handles from rest; others stay. The shape is solved for before the next picture.
   * Throws an Error for unknown names, numbers that are not finite, or without a model of handles. */
  setHandles(motions: Readonly<Record<string, HandleMotion>>): void;
  /** Where the handles are. */
  readonly handles: Record<string, Required<HandleMotion>>;
  /** Weights of the poses; those that are missing are zero, and the sum must be one.
   * Throws an Error for unknown names, other sums, or without a model of poses. */
  setWeights(weights: Readonly<Record<string, number>>): void;
  readonly weights: Record<string, number>;
  /** Back to rest, or to equal weights. */
  reset(): void;
  /** Plays the timeline that the model was saved with. Throws an Error if it has none. */
  play(): void;
  pause(): void;
  readonly isPlaying: boolean;
  /** Positions of the surface as it is shown, 3 per vertex, and its triangles. Throws an Error without a model. */
  shape(): { positions: Float32Array; faces: Uint32Array };
  /** A PNG picture with a transparent background. Rejects with an Error without a model. */
  picture(width: number, height: number): Promise<Blob>;

  addEventListener<K extends keyof SnapspaceViewerEventMap>(
    type: K,
    listener: (this: SnapspaceViewerElement, event: SnapspaceViewerEventMap[K]) => unknown,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject,
    options?: boolean | AddEventListenerOptions,
  ): void;
}

declare global {
  interface HTMLElementTagNameMap {
    "snapspace-viewer": SnapspaceViewerElement;
  }
}
