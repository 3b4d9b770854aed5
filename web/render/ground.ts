import { Geometry } from "./geometry.ts";
import { LIGHTING } from "./lighting.ts";
import { material, Mesh } from "./mesh.ts";
import type { Uniform } from "./program.ts";

const HALF = 6;

const VERTEX = `
uniform mat4 model, view, projection;
in vec3 position;
out vec3 place;
void main() {
  place = (model * vec4(position, 1.0)).xyz;
  gl_Position = projection * view * vec4(place, 1.0);
}`;

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
    const corners = new Float32Array([-HALF, 0, HALF, HALF, 0, HALF, HALF, 0, -HALF, -HALF, 0, -HALF]);
    const opacity = { value: 0.28 };
    super(
      new Geometry({ position: { data: corners, size: 3 } }, new Uint32Array([0, 1, 2, 0, 2, 3])),
      material({ vertex: VERTEX, fragment: FRAGMENT, uniforms: { opacity } }, { isTransparent: true }),
    );
    this.#opacity = opacity;
    this.renderOrder = -1; // it hides what is transparent and below it
  }

  /** Of the darkest shadow. */
  set opacity(opacity: number) {
    this.#opacity.value = opacity;
  }
}
