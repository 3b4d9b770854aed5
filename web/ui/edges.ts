/** The three edges of each face, two vertices each. */
export function edgesOf(faces: Uint32Array): Uint32Array<ArrayBuffer> {
  const edges = new Uint32Array(2 * faces.length);
  for (let from = 0, to = 0; from < faces.length; from += 3)
    for (let side = 0; side < 3; side++) {
      edges[to++] = faces[from + side];
      edges[to++] = faces[from + ((side + 1) % 3)];
    }
  return edges;
}
