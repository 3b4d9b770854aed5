import type { Ghost } from "./ghosts.ts";
import { drawAt } from "./picture.ts";
import type { Stage } from "./stage.ts";
import type { Surface } from "./surface.ts";

const SIZE = { width: 96, height: 72 };
const PAUSE = 60; // milliseconds between two pictures: the page answers meanwhile

/** What small pictures are taken of. */
export interface Pictured<State> {
  /** The surface that is shown. */
  readonly surface: Surface;
  /** The shapes of states; the present one stays. */
  shapes(states: readonly State[]): Ghost[];
  /** Hides what is no part of the shape; the result shows it again. */
  bare(): () => void;
}

/** Small pictures of states: of the stage where the user made a key, and of the other keys one after the other. */
export class KeyPictures<State> {
  readonly #stage: Stage;
  readonly #pictured: Pictured<State>;
  readonly #onPicture: (state: State, picture: string) => void;
  readonly #pictures = new Map<State, string>();
  #timer = 0;

  /** `onPicture` is called for those that came later. */
  constructor(stage: Stage, pictured: Pictured<State>, onPicture: (state: State, picture: string) => void) {
    [this.#stage, this.#pictured, this.#onPicture] = [stage, pictured, onPicture];
  }

  of(state: State): string | undefined {
    return this.#pictures.get(state);
  }

  /** Takes the picture of the present state. */
  take(state: State): void {
    if (this.#stage.renderer.graphics.isLost) return;
    const show = this.#pictured.bare();
    try {
      this.#pictures.set(
        state,
        drawAt(this.#stage, SIZE, null, (canvas) => canvas.toDataURL()),
      );
    } finally {
      show();
    }
  }

  /** Another state takes over the picture of a state. */
  become(state: State, other: State): void {
    const picture = this.of(state);
    if (picture) this.#pictures.set(other, picture);
  }

  /** Takes missing pictures of these states soon, instead of those that were wanted before. */
  want(states: readonly State[]): void {
    clearTimeout(this.#timer);
    const [next, ...later] = states.filter((state) => !this.of(state));
    if (next === undefined) return;
    this.#timer = window.setTimeout(() => {
      this.#takeAt(next);
      const picture = this.of(next);
      if (!picture) return; // the graphics are lost
      this.#onPicture(next, picture);
      this.want(later);
    }, PAUSE);
  }

  dispose(): void {
    clearTimeout(this.#timer);
  }

  /** Takes the picture of another state; the present one is restored before the browser shows anything. */
  #takeAt(state: State): void {
    const { surface } = this.#pictured;
    const [{ coefficients, carriedBy }] = this.#pictured.shapes([state]);
    const [before, share] = surface.blended;
    const matrix = surface.object.matrix.clone();
    surface.show(coefficients);
    surface.carry(carriedBy);
    this.take(state);
    surface.show(before);
    surface.blend(share);
    surface.object.matrix.copy(matrix);
    surface.object.matrixWorldNeedsUpdate = true;
    this.#stage.renderer.render(this.#stage.scene, this.#stage.camera);
  }
}
