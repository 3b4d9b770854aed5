import { symmetricEigen } from "./symmetric_eigen.ts";
import { triangleHats, type TriangleHats } from "./triangle_hats.ts";

/** Moduli per row of the density "shell-arap", see core/material/shell_arap.h. */
export const STAR_MODULI = 12;
/** Mean squared sines between the planes of a star and one normal, below which it is flat. */
const FLAT = 1e-20;

/** An as-rigid-as-possible surface. */
export interface RigidSurface {
  readonly triangles: Int32Array;
  /** Modulus times thickness of each triangle. */
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
  /** Corners of star i: first[i] to before first[i + 1], three numbers of the gradient each. */
  readonly #first: Int32Array;
  readonly #corners: Int32Array;
  readonly #gradients: Float64Array;

  constructor(shape: Float64Array, surface: RigidSurface, chosen: readonly StarTriangles[]) {
    const hats = triangleHats(shape, surface.triangles);
    const stars = chosen.map((own) => starOf(own, surface, hats));
    this.areas = Float64Array.from(stars, (star) => star.area);
    this.moduli = new Float64Array(STAR_MODULI * stars.length);
    stars.forEach(({ weight, area, L }, star) => {
      const row = [weight / area, 0, 0, ...L.flatMap(([x, y]) => [x, y]), ...L.map((of) => of[2])];
      this.moduli.set(row, STAR_MODULI * star);
    });
    this.#first = new Int32Array(stars.length + 1);
    stars.forEach(({ gradients }, i) => (this.#first[i + 1] = this.#first[i] + gradients.size));
    this.#corners = Int32Array.from(stars.flatMap(({ gradients }) => [...gradients.keys()]));
    this.#gradients = Float64Array.from(stars.flatMap(({ gradients }) => [...gradients.values()].flat()));
  }

  /** The nine numbers of displacements (3n) in all stars, stars x 9. */
  numbers(displacements: Float64Array): Float64Array {
    const [first, corners, gradients] = [this.#first, this.#corners, this.#gradients];
    const numbers = new Float64Array(9 * this.areas.length);
    for (let star = 0; star < this.areas.length; star++) {
      let xx = 0, xy = 0, xz = 0, yx = 0, yy = 0, yz = 0, zx = 0, zy = 0, zz = 0; // prettier-ignore
      for (let corner = first[star]; corner < first[star + 1]; corner++) {
        const vertex = 3 * corners[corner];
        const x = displacements[vertex];
        const y = displacements[vertex + 1];
        const z = displacements[vertex + 2];
        const a = gradients[3 * corner];
        const b = gradients[3 * corner + 1];
        const c = gradients[3 * corner + 2];
        xx += x * a;
        xy += x * b;
        xz += x * c;
        yx += y * a;
        yy += y * b;
        yz += y * c;
        zx += z * a;
        zy += z * b;
        zz += z * c;
      }
      numbers.set([xx, xy, xz, yx, yy, yz, zx, zy, zz], 9 * star);
    }
    return numbers;
  }

  /** The parts of these stars at some vertices, in the same order for all shapes of a surface. */
  parts(vertices: Int32Array): StarParts {
    const place = new Map(Array.from(vertices, (vertex, i) => [vertex, i]));
    const [stars, places, vectors]: number[][] = [[], [], []];
    for (let star = 0; star < this.areas.length; star++) {
      const weight = this.moduli[STAR_MODULI * star] * this.areas[star];
      for (let corner = this.#first[star]; corner < this.#first[star + 1]; corner++) {
        const at = place.get(this.#corners[corner]);
        if (at === undefined) continue;
        stars.push(star);
        places.push(at);
        for (let axis = 0; axis < 3; axis++) vectors.push(weight * this.#gradients[3 * corner + axis]);
      }
    }
    return {
      stars: Int32Array.from(stars),
      places: Int32Array.from(places),
      vectors: Float64Array.from(vectors),
    };
  }
}

interface Star {
  readonly area: number;
  /** The same for area times stiffness. */
  readonly weight: number;
  /** L L^T is the mean of the projections onto the planes of the triangles. */
  readonly L: number[][];
  /** Gradients by corner: the nine numbers are the sum of displacement (x) gradient. */
  readonly gradients: Map<number, number[]>;
}

function starOf(own: StarTriangles, { triangles, stiffness }: RigidSurface, hats: TriangleHats): Star {
  const { areas, units, gradients: ofHats } = hats;
  const count = own.triangles.length;
  let [area, weight] = [0, 0];
  const weights = new Float64Array(count);
  for (let i = 0; i < count; i++) {
    const t = own.triangles[i];
    const share = (own.shares[i] * areas[t]) / 3;
    area += share;
    weight += weights[i] = share * stiffness[t];
  }
  const M = [0, 1, 2].map((r) => [0, 1, 2].map((c) => (r === c ? 1 : 0)));
  for (let i = 0; i < count; i++) {
    const at = 3 * own.triangles[i];
    for (let r = 0; r < 3; r++)
      for (let c = 0; c < 3; c++) M[r][c] -= (weights[i] / weight) * units[at + r] * units[at + c];
  }
  const axes = symmetricEigen(M).vectors;
  // not the eigenvalues, since the least one of a nearly flat star is a small difference in M
  const roots = axes.map(([x, y, z]) => {
    let square = 0;
    for (let i = 0; i < count; i++) {
      const at = 3 * own.triangles[i];
      const [a, b, c] = [units[at], units[at + 1], units[at + 2]];
      square += (weights[i] / weight) * ((y * c - z * b) ** 2 + (z * a - x * c) ** 2 + (x * b - y * a) ** 2);
    }
    return square > FLAT ? Math.sqrt(square) : 0;
  });
  const gradients = new Map<number, number[]>(); // in space at first
  for (let i = 0; i < count; i++) {
    const t = own.triangles[i];
    for (let corner = 0; corner < 3; corner++) {
      const vertex = triangles[3 * t + corner];
      const sums = gradients.get(vertex) ?? [0, 0, 0];
      const at = 9 * t + 3 * corner;
      for (let axis = 0; axis < 3; axis++) sums[axis] += (weights[i] / weight) * ofHats[at + axis];
      gradients.set(vertex, sums);
    }
  }
  for (const [vertex, [x, y, z]] of gradients)
    gradients.set(
      vertex,
      axes.map(([a, b, c], k) => (roots[k] > 0 ? (x * a + y * b + z * c) / roots[k] : 0)),
    );
  const L = [0, 1, 2].map((r) => axes.map((axis, k) => axis[r] * roots[k]));
  return { area, weight, L, gradients };
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
