import type { Color } from "three";

import { SCREEN } from "./lighting.ts";
import { material, type Material } from "./mesh.ts";

const VERTEX = `
uniform mat4 model, view, projection;
uniform float nearer;
in vec3 position;
void main() {
  gl_Position = projection * view * model * vec4(position, 1.0);
  gl_Position.z -= nearer * gl_Position.w;
}`;

/** Fragments of one colour. */
export const FLAT = `
precision highp float;
uniform vec3 color;
uniform float opacity;
out vec4 shown;
${SCREEN}
void main() { shown = vec4(onScreen(color), opacity); }`;

/** By how much of the depths edges and patches are before the faces that they lie on. */
export const NEARER = 1e-5;

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
