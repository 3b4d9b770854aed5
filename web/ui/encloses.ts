import { Vector3 } from "three";

/** Whether faces enclose a body, so that nobody outside sees their backs.
 *
 * Each edge then runs once in each direction, and a sum of what changes its sign with that vanishes: a hash of 32 bits,
 * which takes one open surface of four billion for a closed one. */
export function encloses(faces: Uint32Array, shape: Float32Array): boolean {
  let [open, volume] = [0, 0];
  const places = [new Vector3(), new Vector3(), new Vector3()];
  for (let at = 0; at < faces.length; at += 3) {
    places.forEach((place, corner) => {
      const [a, b] = [faces[at + corner], faces[at + ((corner + 1) % 3)]];
      open = (open + Math.imul(a - b, Math.imul(a + b, Math.imul(a, b) ^ 0x9e3779b1))) | 0;
      place.fromArray(shape, 3 * a);
    });
    volume += places[0].dot(places[1].cross(places[2]));
  }
  return open === 0 && volume > 0;
}
