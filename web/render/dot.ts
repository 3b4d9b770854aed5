import type { Color } from "three";

import { SCREEN } from "./lighting.ts";
import { material, Mesh } from "./mesh.ts";
import { quad } from "./quad.ts";

const VERTEX = `
uniform mat4 model, view, projection;
in vec3 position;
out vec2 at;
void main() {
  at = position.xy;
  vec4 middle = view * model * vec4(0.0, 0.0, 0.0, 1.0);
  gl_Position = projection * (middle + vec4(0.5 * length(model[0].xyz) * at, 0.0, 0.0));
}`;

/** Radii as shares of half the size. */
const FRAGMENT = `
uniform vec3 color;
in vec2 at;
out vec4 shown;
${SCREEN}
void main() {
  float away = length(at), pixel = fwidth(away);
  float shade = clamp((0.94 - away) / pixel + 0.5, 0.0, 1.0);
  float rim = clamp((0.84 - away) / pixel + 0.5, 0.0, 1.0);
  float inside = clamp((0.62 - away) / pixel + 0.5, 0.0, 1.0);
  vec3 disc = mix(vec3(1.0), onScreen(color), inside);
  shown = vec4(mix(vec3(0.08, 0.09, 0.13), disc, rim), mix(0.28 * shade, 1.0, rim));
}`;

/** A disc with a white rim that faces the camera, in front of everything. Its scale is its diameter. */
export class Dot extends Mesh {
  constructor(color: Color) {
    super(
      quad([-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]),
      material(
        { vertex: VERTEX, fragment: FRAGMENT, uniforms: { color: { value: color.toArray() } } },
        { isTransparent: true, depthTest: false, depthWrite: false },
      ),
    );
    this.renderOrder = 5;
  }
}
