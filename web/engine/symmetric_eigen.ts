/** Orthonormal eigenvectors of a symmetric matrix, one per row, by cyclic Jacobi rotations; values[i] belongs to vectors[i]. */
export function symmetricEigen(N: readonly (readonly number[])[]): {
  values: number[];
  vectors: number[][];
} {
  const n = N.length;
  const A = N.map((row) => [...row]);
  const V = A.map((_, i) => A.map((_, j) => (i === j ? 1 : 0)));
  for (let sweep = 0; sweep < 30; sweep++)
    for (let p = 0; p < n; p++)
      for (let q = p + 1; q < n; q++) {
        if (A[p][q] === 0) continue;
        const theta = 0.5 * Math.atan2(2 * A[p][q], A[q][q] - A[p][p]);
        const [c, s] = [Math.cos(theta), Math.sin(theta)];
        const turn = (row: number[]) =>
          ([row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]]);
        A.forEach(turn);
        for (let k = 0; k < n; k++)
          [A[p][k], A[q][k]] = [c * A[p][k] - s * A[q][k], s * A[p][k] + c * A[q][k]];
        V.forEach(turn);
      }
  return { values: A.map((row, i) => row[i]), vectors: A.map((_, i) => V.map((row) => row[i])) };
}
