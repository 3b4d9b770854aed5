/** Linear tets or triangles of density one. */
export interface Mass {
  /** Tets, or triangles. */
  readonly cells: Int32Array;
  /** Corners of each cell. */
  readonly corners: 3 | 4;
  /** Signed volumes of tets; areas of triangles, times thickness. */
  readonly volumes: Float64Array;
}

/** The share of each vertex in the volumes of its cells. */
export function vertexMasses({ cells, corners, volumes }: Mass, vertices: number): Float64Array {
  const masses = new Float64Array(vertices);
  cells.forEach((vertex, i) => (masses[vertex] += volumes[Math.floor(i / corners)] / corners));
  return masses;
}
