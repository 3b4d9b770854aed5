import type { Vector } from "./motion.ts";
import { MovingBalls, writeBalls } from "./moving_balls.ts";
import { distanceAlong } from "./ray_triangle.ts";
import type { ShapeSpace } from "./shape_space.ts";
import { surfaceGroups, type SurfaceGroups } from "./surface_groups.ts";

/** Where a ray hits a surface. */
export interface Hit {
  /** The distance along the ray, in lengths of the direction. */
  readonly along: number;
  readonly point: Vector;
  /** The corners of the triangle, the closest to the point first. */
  readonly corners: readonly number[];
}

/** Finds what a ray hits of base + sum_i c_i modes_i without computing that shape: only the vertices near the ray. */
export class ShapePicker {
  readonly #space: ShapeSpace;
  readonly #faces: Uint32Array;
  readonly #groups: SurfaceGroups;
  readonly #moving: MovingBalls;
  readonly #balls: Float32Array;
  readonly #goalBalls: Float32Array;
  /** Positions, of the vertices whose stamp is the present one. */
  readonly #shape: Float32Array;
  readonly #stamps: Uint32Array;
  #stamp = 0;
  #coefficients: ArrayLike<number> = [];
  #goal: Float32Array | null = null;
  #share = 0;
  #isFresh = false;
  #isGoalFresh = false;

  constructor(space: ShapeSpace, faces: Uint32Array) {
    this.#space = space;
    this.#faces = faces;
    this.#groups = surfaceGroups(space.base, faces);
    this.#moving = new MovingBalls(space, this.#groups);
    this.#balls = new Float32Array(4 * this.#groups.count);
    this.#goalBalls = new Float32Array(4 * this.#groups.count);
    this.#shape = new Float32Array(space.base.length);
    this.#stamps = new Uint32Array(space.vertices);
  }

  /** Sets the shape, or the one at a share of the path from there to the goal. Costs nothing until something is picked.
   * */
  show(coefficients: ArrayLike<number>, share = 0): void {
    this.#coefficients = coefficients;
    this.#share = this.#goal ? share : 0;
    this.#isFresh = false;
  }

  /** The shape to blend to, 3 numbers per vertex. */
  set goal(positions: Float32Array) {
    this.#goal = positions;
    this.#isFresh = this.#isGoalFresh = false;
  }

  /** The first hit of a ray whose direction has length one; null beside the surface. */
  pick(origin: Vector, direction: Vector): Hit | null {
    this.#refresh();
    const [ox, oy, oz] = origin;
    const [dx, dy, dz] = direction;
    let along = Infinity;
    let face = -1;
    for (const [group, enters] of this.#reached(origin, direction)) {
      if (enters > along) break;
      this.#place(group);
      const { starts, triangles } = this.#groups;
      for (let i = starts[group]; i < starts[group + 1]; i++) {
        const f = 3 * triangles[i];
        const t = distanceAlong(this.#shape, this.#faces, f, ox, oy, oz, dx, dy, dz);
        if (t < along) [along, face] = [t, f];
      }
    }
    if (face < 0) return null;
    const point: Vector = [ox + along * dx, oy + along * dy, oz + along * dz];
    const away = (vertex: number) =>
      Math.hypot(...point.map((x, axis) => this.#shape[3 * vertex + axis] - x));
    const corners = [...this.#faces.subarray(face, face + 3)].sort((a, b) => away(a) - away(b));
    return { along, point, corners };
  }

  /** Groups whose balls the ray passes through, and where it enters them, ascending. */
  #reached([ox, oy, oz]: Vector, [dx, dy, dz]: Vector): [group: number, enters: number][] {
    const balls = this.#balls;
    const found: [number, number][] = [];
    for (let b = 0; b < balls.length; b += 4) {
      const x = balls[b] - ox;
      const y = balls[b + 1] - oy;
      const z = balls[b + 2] - oz;
      const middle = x * dx + y * dy + z * dz;
      const half = balls[b + 3] ** 2 - (x * x + y * y + z * z - middle * middle);
      if (half < 0) continue;
      const root = Math.sqrt(half);
      if (middle + root >= 0) found.push([b / 4, middle - root]);
    }
    return found.sort((first, second) => first[1] - second[1]);
  }

  /** The balls of the present shape. */
  #refresh(): void {
    if (this.#isFresh) return;
    this.#isFresh = true;
    this.#stamp++;
    const balls = this.#balls;
    this.#moving.at(this.#coefficients, balls);
    if (this.#share === 0) return;
    if (!this.#isGoalFresh) writeBalls(this.#goal!, this.#groups, this.#goalBalls);
    this.#isGoalFresh = true;
    for (let i = 0; i < balls.length; i++) balls[i] += this.#share * (this.#goalBalls[i] - balls[i]);
  }

  /** The positions of a group's vertices in the present shape. */
  #place(group: number): void {
    const { base, modes, scales } = this.#space;
    const { vertices, vertexStarts } = this.#groups;
    const shape = this.#shape;
    for (let i = vertexStarts[group]; i < vertexStarts[group + 1]; i++) {
      const vertex = vertices[i];
      if (this.#stamps[vertex] === this.#stamp) continue;
      this.#stamps[vertex] = this.#stamp;
      const v = 3 * vertex;
      let x = base[v];
      let y = base[v + 1];
      let z = base[v + 2];
      for (let mode = 0, at = v; mode < this.#coefficients.length; mode++, at += base.length) {
        const factor = this.#coefficients[mode] * scales[mode];
        x += factor * modes[at];
        y += factor * modes[at + 1];
        z += factor * modes[at + 2];
      }
      if (this.#share > 0) {
        const goal = this.#goal!;
        x += this.#share * (goal[v] - x);
        y += this.#share * (goal[v + 1] - y);
        z += this.#share * (goal[v + 2] - z);
      }
      shape[v] = x;
      shape[v + 1] = y;
      shape[v + 2] = z;
    }
  }
}
