interface Rings {
  readonly ranges: Int32Array<ArrayBuffer>;
  readonly pairs: Int32Array<ArrayBuffer>;
}

/** The faces around each vertex: for vertex v its pairs [start, start + count) are the other two corners of
 * its faces, in the faces' orientation. */
export function rings(faces: Uint32Array, vertices: number): Rings {
  const ranges = new Int32Array(2 * vertices);
  faces.forEach((vertex) => ranges[2 * vertex + 1]++);
  for (let vertex = 1; vertex < vertices; vertex++)
    ranges[2 * vertex] = ranges[2 * vertex - 2] + ranges[2 * vertex - 1];
  const filled = new Int32Array(vertices);
  const pairs = new Int32Array(2 * faces.length);
  faces.forEach((vertex, corner) => {
    const face = corner - (corner % 3);
    const slot = 2 * (ranges[2 * vertex] + filled[vertex]++);
    pairs[slot] = faces[face + ((corner + 1) % 3)];
    pairs[slot + 1] = faces[face + ((corner + 2) % 3)];
  });
  return { ranges, pairs };
}
