import type { ShapeSpace } from "./shape_space.ts";
import type { SurfaceGroups } from "./surface_groups.ts";

const SLACK = 1e-5; // share of the radius, for rounding to single precision

/** A ball around each group of a surface, for every shape of a space, in the time of some hundred vertices.
 *
 * The middle moves with the mean of the modes over the group, and the radius grows by |c_i| times the farthest that mode i
 * is from its mean there (James and Pai, "BD-Tree: output-sensitive collision detection for reduced deformable models",
 * 2004). */
export class MovingBalls {
  readonly #scales: Float32Array;
  readonly #count: number;
  /** x, y, z and radius per group: of the base, then of one mode after the other in its integers. */
  readonly #parts: Float32Array;

  constructor(space: ShapeSpace, groups: SurfaceGroups) {
    const size = space.base.length;
    this.#scales = space.scales;
    this.#count = groups.count;
    this.#parts = new Float32Array(4 * groups.count * (1 + space.scales.length));
    writeBalls(space.base, groups, this.#parts);
    for (let mode = 0; mode < space.scales.length; mode++)
      writeBalls(
        space.modes.subarray(mode * size, (mode + 1) * size),
        groups,
        this.#parts.subarray(4 * groups.count * (mode + 1)),
      );
  }

  /** Writes x, y, z and radius per group for base + sum_i c_i modes_i. */
  at(coefficients: ArrayLike<number>, balls: Float32Array): void {
    const length = 4 * this.#count;
    const parts = this.#parts;
    for (let i = 0; i < length; i++) balls[i] = parts[i];
    for (let mode = 0; mode < coefficients.length; mode++) {
      const factor = coefficients[mode] * this.#scales[mode];
      const growth = Math.abs(factor);
      const start = length * (mode + 1);
      for (let i = 0; i < length; i += 4) {
        balls[i] += factor * parts[start + i];
        balls[i + 1] += factor * parts[start + i + 1];
        balls[i + 2] += factor * parts[start + i + 2];
        balls[i + 3] += growth * parts[start + i + 3];
      }
    }
  }
}

/** Around the mean of each group of rows of 3 numbers, x, y, z and radius. */
export function writeBalls(rows: ArrayLike<number>, groups: SurfaceGroups, balls: Float32Array): void {
  const { vertices, vertexStarts } = groups;
  for (let group = 0; group < groups.count; group++) {
    const [start, end] = [vertexStarts[group], vertexStarts[group + 1]];
    let x = 0;
    let y = 0;
    let z = 0;
    for (let i = start; i < end; i++) {
      const v = 3 * vertices[i];
      x += rows[v];
      y += rows[v + 1];
      z += rows[v + 2];
    }
    [x, y, z] = [x / (end - start), y / (end - start), z / (end - start)];
    let farthest = 0;
    for (let i = start; i < end; i++) {
      const v = 3 * vertices[i];
      const away = (rows[v] - x) ** 2 + (rows[v + 1] - y) ** 2 + (rows[v + 2] - z) ** 2;
      if (away > farthest) farthest = away;
    }
    const b = 4 * group;
    balls[b] = x;
    balls[b + 1] = y;
    balls[b + 2] = z;
    balls[b + 3] = Math.sqrt(farthest) + SLACK * (Math.sqrt(farthest) + Math.hypot(x, y, z));
  }
}
