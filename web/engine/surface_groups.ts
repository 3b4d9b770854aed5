import { splitInMiddle, triangleCenters } from "./triangle_split.ts";

const MOST_TRIANGLES = 64;

/** Groups of neighbouring triangles of a surface. */
export interface SurfaceGroups {
  readonly count: number;
  /** Triangles, group by group: those of group g are from starts[g] to starts[g + 1]. */
  readonly triangles: Uint32Array;
  readonly starts: Uint32Array;
  /** The corners of each group's triangles, each once, in the same manner. */
  readonly vertices: Uint32Array;
  readonly vertexStarts: Uint32Array;
}

export function surfaceGroups(shape: Float32Array, faces: Uint32Array): SurfaceGroups {
  const triangles = Uint32Array.from({ length: faces.length / 3 }, (_, i) => i);
  const centers = triangleCenters(shape, faces);
  const ends: number[] = [];
  const waiting: [start: number, end: number][] = [[0, triangles.length]];
  for (let job = waiting.pop(); job; job = waiting.pop()) {
    const [start, end] = job;
    if (end - start <= MOST_TRIANGLES) {
      if (end > start) ends.push(end);
      continue;
    }
    const [middle] = splitInMiddle(triangles, centers, start, end);
    waiting.push([middle, end], [start, middle]); // the first half first: ends ascend
  }
  const vertices = new Uint32Array(faces.length);
  const vertexStarts = new Uint32Array(ends.length + 1);
  const lastGroup = new Int32Array(shape.length / 3).fill(-1);
  let count = 0;
  ends.forEach((end, group) => {
    for (let i = group ? ends[group - 1] : 0; i < end; i++)
      for (let corner = 0; corner < 3; corner++) {
        const vertex = faces[3 * triangles[i] + corner];
        if (lastGroup[vertex] === group) continue;
        lastGroup[vertex] = group;
        vertices[count++] = vertex;
      }
    vertexStarts[group + 1] = count;
  });
  return {
    count: ends.length,
    triangles,
    starts: Uint32Array.of(0, ...ends),
    vertices: vertices.slice(0, count),
    vertexStarts,
  };
}
