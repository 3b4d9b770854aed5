import type { BlendingModel } from "./model.ts";

/** Densities whose blends collapse (Material.collapses of the Python package); the others have no cheap test. */
const COLLAPSING = ["stable-neo-hookean"];
const TERMS = 7; // per tet and pose: v A A^T (xx, yy, zz, yz, xz, xy) and 1 / v
const HALVINGS = 24;

/** Weights for which the blended energy certainly has a minimum: in all tets of the cubature M is positive definite, and
 * alpha is. As CertainRange of the Python package. */
export class CertainRange {
  readonly #poses: number;
  readonly #terms: Float64Array;

  /** Null where no test is known. */
  static of({ blends, material, poses }: BlendingModel): CertainRange | null {
    if (blends.kind !== "cubature" || !COLLAPSING.includes(material)) return null;
    return new CertainRange(blends.corners, blends.weights.length, poses.length);
  }

  /** `corners` of the tets in every pose: poses x tets x 4 x 3; what follows is not read. */
  constructor(corners: Float64Array, tets: number, poses: number) {
    this.#poses = poses;
    this.#terms = new Float64Array(TERMS * tets * poses);
    for (let tet = 0; tet < tets; tet++) {
      const first = edgesOf(corners, tet);
      for (let pose = 0; pose < poses; pose++)
        this.#terms.set(termsOf(first, edgesOf(corners, pose * tets + tet)), TERMS * (tet * poses + pose));
    }
  }

  /** Whether these weights are in the range, without its bound. */
  holds(weights: readonly number[]): boolean {
    const terms = this.#terms;
    const sum = new Float64Array(TERMS);
    for (let start = 0; start < terms.length; start += TERMS * this.#poses) {
      sum.fill(0);
      for (let pose = 0; pose < this.#poses; pose++)
        for (let e = 0; e < TERMS; e++) sum[e] += weights[pose] * terms[start + TERMS * pose + e];
      if (!isPositive(sum)) return false;
    }
    return true;
  }

  /** The largest t <= `most` up to which start + t step is in the range. */
  reach(start: readonly number[], step: readonly number[], most: number): number {
    const at = (t: number) => start.map((w, pose) => w + t * step[pose]);
    if (this.holds(at(most))) return most;
    let [within, beyond] = [0, most];
    for (let i = 0; i < HALVINGS; i++) {
      const middle = (within + beyond) / 2;
      if (this.holds(at(middle))) within = middle;
      else beyond = middle;
    }
    return within;
  }
}

/** Edges of a tet from its first corner, as the rows of a matrix. */
function edgesOf(corners: Float64Array, tet: number): number[][] {
  const at = (corner: number, axis: number) => corners[12 * tet + 3 * corner + axis];
  return [1, 2, 3].map((corner) => [0, 1, 2].map((axis) => at(corner, axis) - at(0, axis)));
}

/** v A A^T and 1 / v in units of the volume in pose 0, with A^T = edges^-1 first. */
function termsOf(first: number[][], edges: number[][]): number[] {
  const columns = cofactors(edges); // the inverse is their transpose over det
  const det = determinant(edges);
  const volume = Math.abs(det / determinant(first));
  const map = [0, 1, 2].map((r) =>
    [0, 1, 2].map((c) => [0, 1, 2].reduce((sum, k) => sum + columns[k][r] * first[k][c], 0) / det),
  );
  const square = (a: number, b: number) => volume * map.reduce((sum, row) => sum + row[a] * row[b], 0);
  return [square(0, 0), square(1, 1), square(2, 2), square(1, 2), square(0, 2), square(0, 1), 1 / volume];
}

function cofactors([a, b, c]: number[][]): number[][] {
  return [cross(b, c), cross(c, a), cross(a, b)];
}

function determinant([a, b, c]: number[][]): number {
  return a.reduce((sum, x, i) => sum + x * cross(b, c)[i], 0);
}

function cross(a: number[], b: number[]): number[] {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** Tested by the leading minors. */
function isPositive([xx, yy, zz, yz, xz, xy, alpha]: Float64Array): boolean {
  const minor = xx * yy - xy * xy;
  const det = zz * minor - xx * yz * yz - yy * xz * xz + 2 * yz * xz * xy;
  return alpha > 0 && xx > 0 && minor > 0 && det > 0;
}
