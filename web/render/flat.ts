import type { Color } from "three";

import { SCREEN } from "./lighting.ts";
import { material, type Material } from "./mesh.ts";

/** GLSL: the place on the screen of a point of the stage, with the depth of one that is nearer by a length. */
export const ON_SCREEN = `
vec4 projected(mat4 view, mat4 projection, vec3 place, float nearer) {
  vec4 seen = view * vec4(place, 1.0), at = projection * seen, before = projection * (seen + vec4(0.0, 0.0, nearer, 0.0));
  return vec4(at.xy, before.z / before.w * at.w, at.w);
}
`;

const VERTEX = `
uniform mat4 model, view, projection;
uniform float nearer;
in vec3 position;
${ON_SCREEN}
void main() { gl_Position = projected(view, projection, (model * vec4(position, 1.0)).xyz, nearer); }`;

/** Fragments of one colour. */
export const FLAT = `
uniform vec3 color;
uniform float opacity;
out vec4 shown;
${SCREEN}
void main() { shown = vec4(onScreen(color), opacity); }`;

/** The length by which edges and patches are before the faces that they lie on. */
export const NEARER = 0.002;

/** One colour, whatever the light is. `isNearer` draws it before faces in the same place. */
export function flat(
  color: Color,
  opacity = 1,
  { isNearer = false, ...options }: Partial<Omit<Material, "uniforms">> & { isNearer?: boolean } = {},
): Material {
  const uniforms = {
    color: { value: color.toArray() },
    opacity: { value: opacity },
    nearer: { value: isNearer ? NEARER : 0 },
  };
  return material({ vertex: VERTEX, fragment: FLAT, uniforms }, { isTransparent: opacity < 1, ...options });
}
