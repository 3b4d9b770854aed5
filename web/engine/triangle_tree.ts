import type { Vector } from "./motion.ts";
import { distanceAlong } from "./ray_triangle.ts";
import { splitInMiddle, triangleCenters } from "./triangle_split.ts";

const LEAF = 4;

/** Boxes in boxes around the triangles of a shape at rest, for rays (Kay and Kajiya 1986).
 *
 * Nodes are split in the middle of their triangles' centres, or by their number where that leaves one side empty; and
 * only once a ray enters them: a page that opens a large mesh does not wait for the whole tree. */
export class TriangleTree {
  readonly #shape: Float32Array;
  readonly #faces: Uint32Array;
  readonly #centers: Float32Array;
  /** Triangles, node by node. */
  readonly #order: Uint32Array;
  /** Six numbers per node: lowest and highest corner. */
  readonly #boxes: Float32Array;
  /** Per node its range in #order until it is split; then its first child, the second is the next node, and -1 less
   * the axis that it was split along. */
  readonly #ranges: Int32Array;
  readonly #stack = new Int32Array(128);
  #nodes = 1;

  constructor(shape: Float32Array, faces: Uint32Array) {
    const count = faces.length / 3;
    this.#shape = shape;
    this.#faces = faces;
    this.#centers = triangleCenters(shape, faces);
    this.#order = new Uint32Array(count);
    for (let i = 0; i < count; i++) this.#order[i] = i;
    this.#boxes = new Float32Array(6 * Math.max(2 * count, 1));
    this.#ranges = new Int32Array(2 * Math.max(2 * count, 1));
    this.#ranges[1] = count;
    this.#enclose(0);
  }

  /** The first triangle that a ray hits, and how far in lengths of the direction; null if there is none. */
  hit(origin: Vector, direction: Vector): { face: number; along: number } | null {
    const found = this.#trace(origin, direction, 0, Infinity, false);
    return found.face < 0 ? null : found;
  }

  /** Whether a triangle is hit between two lengths of the direction. */
  isBlocked(origin: Vector, direction: Vector, from: number, to: number): boolean {
    return this.#trace(origin, direction, from, to, true).face >= 0;
  }

  #trace([ox, oy, oz]: Vector, [dx, dy, dz]: Vector, from: number, to: number, any: boolean) {
    const [ix, iy, iz] = [1 / dx, 1 / dy, 1 / dz];
    const boxes = this.#boxes;
    const stack = this.#stack;
    let [face, along] = [-1, to];
    let depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const node = stack[--depth];
      const b = 6 * node;
      const x0 = (boxes[b] - ox) * ix;
      const x1 = (boxes[b + 3] - ox) * ix;
      const y0 = (boxes[b + 1] - oy) * iy;
      const y1 = (boxes[b + 4] - oy) * iy;
      const z0 = (boxes[b + 2] - oz) * iz;
      const z1 = (boxes[b + 5] - oz) * iz;
      const enters = Math.max(Math.min(x0, x1), Math.min(y0, y1), Math.min(z0, z1));
      const leaves = Math.min(Math.max(x0, x1), Math.max(y0, y1), Math.max(z0, z1));
      // with NaN, from a ray in a face of the box, every comparison is false and the box is looked into
      if (enters > leaves || enters > along || leaves < from) continue;
      if (this.#ranges[2 * node + 1] - this.#ranges[2 * node] > LEAF) this.#split(node);
      const start = this.#ranges[2 * node];
      const end = this.#ranges[2 * node + 1];
      if (end < 0) {
        const forwards = (end === -1 ? dx : end === -2 ? dy : dz) > 0;
        stack[depth++] = forwards ? start + 1 : start; // the nearer one last, so that it is taken first
        stack[depth++] = forwards ? start : start + 1;
        continue;
      }
      for (let i = start; i < end; i++) {
        const f = this.#order[i];
        const t = distanceAlong(this.#shape, this.#faces, 3 * f, ox, oy, oz, dx, dy, dz);
        if (t <= from || t >= along) continue;
        [face, along] = [f, t];
        if (any) return { face, along };
      }
    }
    return { face, along };
  }

  #split(node: number): void {
    const [start, end] = this.#ranges.subarray(2 * node, 2 * node + 2);
    const [middle, axis] = splitInMiddle(this.#order, this.#centers, start, end);
    const first = this.#nodes;
    this.#nodes += 2;
    this.#ranges.set([first, -1 - axis], 2 * node);
    this.#ranges.set([start, middle, middle, end], 2 * first);
    this.#enclose(first);
    this.#enclose(first + 1);
  }

  #enclose(node: number): void {
    const boxes = this.#boxes;
    const b = 6 * node;
    boxes.fill(Infinity, b, b + 3).fill(-Infinity, b + 3, b + 6);
    const start = this.#ranges[2 * node];
    const end = this.#ranges[2 * node + 1];
    for (let i = start; i < end; i++)
      for (let corner = 0; corner < 3; corner++) {
        const v = 3 * this.#faces[3 * this.#order[i] + corner];
        for (let axis = 0; axis < 3; axis++) {
          const x = this.#shape[v + axis];
          if (x < boxes[b + axis]) boxes[b + axis] = x;
          if (x > boxes[b + axis + 3]) boxes[b + axis + 3] = x;
        }
      }
  }
}
