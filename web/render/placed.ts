/** A vertex shader whose fragments get their places on the stage. */
export const PLACED = `
uniform mat4 model, view, projection;
in vec3 position;
out vec3 place;
void main() {
  place = (model * vec4(position, 1.0)).xyz;
  gl_Position = projection * view * vec4(place, 1.0);
}`;
