/** Normals of length one, means of the faces' normals weighted by area; (0, 0, 1) where these cancel. */
export function vertexNormals(shape: Float32Array, faces: Uint32Array): Float32Array<ArrayBuffer> {
  const normals = new Float32Array(shape.length);
  weightedNormals(shape, faces, normals);
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]);
    if (length > 0) for (let axis = 0; axis < 3; axis++) normals[i + axis] /= length;
    else normals[i + 2] = 1;
  }
  return normals;
}

/** Writes sums of the faces' normals, weighted by area; not of length one. */
export function weightedNormals(shape: Float32Array, faces: Uint32Array, normals: Float32Array): void {
  normals.fill(0);
  for (let f = 0; f < faces.length; f += 3) {
    const [a, b, c] = [3 * faces[f], 3 * faces[f + 1], 3 * faces[f + 2]];
    const [ux, uy, uz] = [shape[b] - shape[a], shape[b + 1] - shape[a + 1], shape[b + 2] - shape[a + 2]];
    const [vx, vy, vz] = [shape[c] - shape[a], shape[c + 1] - shape[a + 1], shape[c + 2] - shape[a + 2]];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) {
      normals[corner] += x;
      normals[corner + 1] += y;
      normals[corner + 2] += z;
    }
  }
}
