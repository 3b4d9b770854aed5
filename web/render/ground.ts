import { LIGHTING } from "./lighting.ts";
import { material, Mesh } from "./mesh.ts";
import { PLACED } from "./placed.ts";
import type { Uniform } from "./program.ts";
import { quad } from "./quad.ts";

const HALF = 6;

const FRAGMENT = `
${LIGHTING}
uniform float opacity;
in vec3 place;
out vec4 shown;
void main() {
  if (!gl_FrontFacing) discard;
  shown = vec4(0.0, 0.0, 0.0, opacity * (1.0 - unshadowed(place, vec3(0.0, 1.0, 0.0))));
}`;

/** A ground on which only shadows are seen; nothing from below. */
export class Ground extends Mesh {
  readonly #opacity: Uniform<number>;

  constructor() {
    const opacity = { value: 0.28 };
    super(
      quad([-HALF, 0, HALF], [HALF, 0, HALF], [HALF, 0, -HALF], [-HALF, 0, -HALF]),
      material({ vertex: PLACED, fragment: FRAGMENT, uniforms: { opacity } }, { isTransparent: true }),
    );
    this.#opacity = opacity;
    this.renderOrder = -1; // it hides what is transparent and below it
  }

  /** Opacity of the darkest shadow. */
  set opacity(opacity: number) {
    this.#opacity.value = opacity;
  }
}
