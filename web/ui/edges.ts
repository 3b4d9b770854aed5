/** The edges of faces, two vertices each; an edge of several faces comes once. */
export function edgesOf(faces: Uint32Array): Uint32Array<ArrayBuffer> {
  // pairs as one number each, exact in 53 bits: faster to sort than anything else
  const keys = new Float64Array(faces.length);
  for (let at = 0; at < faces.length; at++) {
    const [a, b] = [faces[at], faces[at % 3 === 2 ? at - 2 : at + 1]];
    keys[at] = Math.min(a, b) * VERTICES + Math.max(a, b);
  }
  keys.sort();
  const once = keys.filter((key, at) => key !== keys[at - 1]);
  const edges = new Uint32Array(2 * once.length);
  once.forEach((key, at) => {
    edges[2 * at] = Math.floor(key / VERTICES);
    edges[2 * at + 1] = key % VERTICES;
  });
  return edges;
}

const VERTICES = 2 ** 26;
