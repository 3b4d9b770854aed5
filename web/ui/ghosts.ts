import type { RigidMap } from "../engine/index.ts";
import { NEARER } from "../render/index.ts";
import { CLAY } from "./handle_colors.ts";
import type { Stage } from "./stage.ts";
import type { Surface } from "./surface.ts";

/** A shape by its coefficients, and where it is carried to. */
export interface Ghost {
  readonly coefficients: ArrayLike<number>;
  readonly carriedBy: RigidMap;
}

const OPACITY = 0.29; // as two layers of 0.16, the front and the back

/** Pale shapes beside the present one. Surfaces are made when they are first needed. */
export class Ghosts {
  readonly #stage: Stage;
  readonly #make: () => Surface;
  #surfaces: Surface[] = [];

  constructor(stage: Stage, make: () => Surface) {
    [this.#stage, this.#make] = [stage, make];
  }

  show(ghosts: readonly Ghost[]): void {
    while (this.#surfaces.length < ghosts.length) {
      const surface = this.#make();
      surface.paint(() => CLAY);
      fade(surface);
      this.#stage.root.add(surface.object);
      this.#surfaces.push(surface);
    }
    this.#surfaces.forEach((surface, k) => {
      surface.object.visible = k < ghosts.length;
      if (!surface.object.visible) return;
      const { coefficients, carriedBy } = ghosts[k];
      surface.show(coefficients);
      surface.carry(carriedBy);
    });
    this.#stage.draw();
  }

  /** Computes them again, after the graphics were lost. */
  refresh(): void {
    for (const surface of this.#surfaces) surface.refresh();
  }

  /** Removes all surfaces, for instance because the model is another one. */
  clear(): void {
    for (const surface of this.#surfaces) {
      surface.object.removeFromParent();
      surface.dispose();
    }
    this.#surfaces = [];
  }
}

/** Draws a surface pale, without a shadow, and behind others in the same place: they would show through each other in spots. */
function fade(surface: Surface): void {
  const { solid } = surface;
  Object.assign(solid.material, {
    vertex: `#define MOVED\n${solid.material.vertex}`,
    isTransparent: true,
    depthWrite: false,
  });
  Object.assign(solid.material.uniforms, { opacity: { value: OPACITY }, nearer: { value: -NEARER } });
  surface.shadowed = solid.castsShadow = false;
}
