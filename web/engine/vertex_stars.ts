import { symmetricEigen } from "./symmetric_eigen.ts";
import { triangleNormals } from "./triangles.ts";

/** Moduli per row of the density "shell-arap", see core/material/shell_arap.h. */
export const STAR_MODULI = 12;
/** Mean squared sines between the planes of a star and one normal, below which it is flat. */
const FLAT = 1e-20;

/** A surface that is as rigid as possible. */
export interface RigidSurface {
  readonly triangles: Int32Array;
  /** Of each triangle, modulus times thickness. */
  readonly stiffness: Float64Array;
}

/** The triangles of a star, and what share of a third of its area times stiffness each has there. */
export interface StarTriangles {
  readonly triangles: ArrayLike<number>;
  readonly shares: ArrayLike<number>;
}

/** Pairs of a star and a vertex whose force its stress is part of: stress times vector. */
export interface StarParts {
  readonly stars: Int32Array;
  /** Indices of the vertices among those asked for. */
  readonly places: Int32Array;
  /** Three numbers each, for the stress of a star of modulus and area one. */
  readonly vectors: Float64Array;
}

/** Some stars of a surface with one shape at rest; as VertexStars of the core. */
export class VertexStars {
  /** The area of each: that of its triangles, shared between stars. */
  readonly areas: Float64Array;
  /** Rows of the density "shell-arap", with the mean stiffness of each as the modulus. */
  readonly moduli: Float64Array<ArrayBuffer>;
  readonly #corners: readonly Int32Array[];
  readonly #gradients: readonly Float64Array[];

  constructor(shape: Float64Array, { triangles, stiffness }: RigidSurface, chosen: readonly StarTriangles[]) {
    const normals = triangleNormals(shape, triangles);
    const stars = chosen.map((own) => starOf(own, { shape, triangles, stiffness, normals }));
    this.areas = Float64Array.from(stars, (star) => star.area);
    this.moduli = new Float64Array(STAR_MODULI * stars.length);
    stars.forEach(({ weight, area, L }, star) => {
      const row = [weight / area, 0, 0, ...L.flatMap(([x, y]) => [x, y]), ...L.map((of) => of[2])];
      this.moduli.set(row, STAR_MODULI * star);
    });
    this.#corners = stars.map((star) => Int32Array.from(star.gradients.keys()));
    this.#gradients = stars.map((star) => Float64Array.from([...star.gradients.values()].flat()));
  }

  /** The nine numbers of displacements (3n) in all stars, stars x 9. */
  numbers(displacements: ArrayLike<number>): Float64Array {
    const numbers = new Float64Array(9 * this.areas.length);
    this.#corners.forEach((corners, star) => {
      const gradients = this.#gradients[star];
      for (let corner = 0; corner < corners.length; corner++)
        for (let e = 0; e < 9; e++)
          numbers[9 * star + e] +=
            displacements[3 * corners[corner] + Math.floor(e / 3)] * gradients[3 * corner + (e % 3)];
    });
    return numbers;
  }

  /** Those of these stars at some vertices, in the same order for all shapes of a surface. */
  parts(vertices: Int32Array): StarParts {
    const place = new Map(Array.from(vertices, (vertex, i) => [vertex, i]));
    const found: { star: number; place: number; vector: number[] }[] = [];
    this.#corners.forEach((corners, star) => {
      const weight = this.moduli[STAR_MODULI * star] * this.areas[star];
      corners.forEach((vertex, corner) => {
        const at = place.get(vertex);
        const gradient = this.#gradients[star].subarray(3 * corner, 3 * corner + 3);
        if (at !== undefined)
          found.push({ star, place: at, vector: Array.from(gradient, (x) => weight * x) });
      });
    });
    return {
      stars: Int32Array.from(found, (part) => part.star),
      places: Int32Array.from(found, (part) => part.place),
      vectors: Float64Array.from(found.flatMap((part) => part.vector)),
    };
  }
}

interface Surface extends RigidSurface {
  readonly shape: Float64Array;
  /** As long as twice the areas. */
  readonly normals: Float64Array;
}

interface Star {
  readonly area: number;
  /** The same of area times stiffness. */
  readonly weight: number;
  /** L L^T is the mean of the projections onto the planes of the triangles. */
  readonly L: number[][];
  /** By corner: the nine numbers are the sum of displacement (x) gradient. */
  readonly gradients: Map<number, number[]>;
}

function starOf({ triangles, shares }: StarTriangles, surface: Surface): Star {
  const own = Array.from(triangles);
  const sizes = own.map((t) => Math.hypot(...vectorOf(surface.normals, t)));
  const units = own.map((t, i) => vectorOf(surface.normals, t).map((x) => x / sizes[i]));
  const weights = own.map((t, i) => (shares[i] * surface.stiffness[t] * sizes[i]) / 6);
  const weight = sum(weights);
  const mean = (of: (i: number) => number) => sum(weights.map((w, i) => (w / weight) * of(i)));
  const M = [0, 1, 2].map((r) =>
    [0, 1, 2].map((c) => mean((i) => (r === c ? 1 : 0) - units[i][r] * units[i][c])),
  );
  const axes = symmetricEigen(M).vectors;
  // not the eigenvalues, since the least one of a nearly flat star is a small difference in M
  const squares = axes.map((axis) => mean((i) => dot(cross(axis, units[i]), cross(axis, units[i]))));
  const roots = squares.map((square) => (square > FLAT ? Math.sqrt(square) : 0));
  const gradients = new Map<number, number[]>();
  own.forEach((t, i) => {
    for (let corner = 0; corner < 3; corner++) {
      const [vertex, from, to] = [0, 1, 2].map((k) => surface.triangles[3 * t + ((corner + k) % 3)]);
      const opposite = minus(vectorOf(surface.shape, to), vectorOf(surface.shape, from));
      const hat = cross(units[i], opposite); // its gradient, times the size
      const sums = gradients.get(vertex) ?? [0, 0, 0];
      roots.forEach((root, k) => {
        if (root > 0) sums[k] += ((weights[i] / weight) * dot(hat, axes[k])) / (sizes[i] * root);
      });
      gradients.set(vertex, sums);
    }
  });
  const L = [0, 1, 2].map((r) => axes.map((axis, k) => axis[r] * roots[k]));
  return { area: sum(sizes.map((size, i) => shares[i] * size)) / 6, weight, L, gradients };
}

/** The stars of some vertices with the triangles around each. */
export function oneRings(triangles: Int32Array, vertices: Int32Array, count: number): StarTriangles[] {
  const place = new Int32Array(count).fill(-1);
  vertices.forEach((vertex, i) => (place[vertex] = i));
  const around: number[][] = Array.from(vertices, () => []);
  triangles.forEach((vertex, corner) => {
    if (place[vertex] >= 0) around[place[vertex]].push(Math.floor(corner / 3));
  });
  return around.map((own) => ({ triangles: own, shares: own.map(() => 1) }));
}

function vectorOf(rows: Float64Array, i: number): number[] {
  return [rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]];
}

const sum = (numbers: readonly number[]) => numbers.reduce((total, x) => total + x, 0);
const dot = (a: readonly number[], b: readonly number[]) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a: readonly number[], b: readonly number[]) => a.map((x, i) => x - b[i]);
const cross = (a: readonly number[], b: readonly number[]) =>
  [0, 1, 2].map((r) => {
    const [s, t] = [(r + 1) % 3, (r + 2) % 3];
    return a[s] * b[t] - a[t] * b[s];
  });
