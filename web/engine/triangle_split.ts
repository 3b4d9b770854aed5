/** The mean of the corners of each triangle, three numbers each. */
export function triangleCenters(shape: Float32Array, faces: Uint32Array): Float32Array {
  const centers = new Float32Array(faces.length);
  for (let f = 0; f < faces.length; f += 3)
    for (let axis = 0; axis < 3; axis++)
      centers[f + axis] =
        (shape[3 * faces[f] + axis] + shape[3 * faces[f + 1] + axis] + shape[3 * faces[f + 2] + axis]) / 3;
  return centers;
}

/** Splits the triangles of a range of `order` into two sides, along the axis in which their centres spread most: in the
 * middle, or by their number where that leaves one side empty. */
export function splitInMiddle(
  order: Uint32Array,
  centers: Float32Array,
  start: number,
  end: number,
): [middle: number, axis: number] {
  let axis = 0;
  let [widest, middle] = [-1, 0];
  for (let candidate = 0; candidate < 3; candidate++) {
    let [low, high] = [Infinity, -Infinity];
    for (let i = start; i < end; i++) {
      const x = centers[3 * order[i] + candidate];
      if (x < low) low = x;
      if (x > high) high = x;
    }
    if (high - low > widest) [widest, middle, axis] = [high - low, (low + high) / 2, candidate];
  }
  let left = start;
  for (let i = start; i < end; i++) {
    const triangle = order[i];
    if (centers[3 * triangle + axis] >= middle) continue;
    order[i] = order[left];
    order[left++] = triangle;
  }
  return [left === start || left === end ? (start + end) >> 1 : left, axis];
}
