import type { BlendingModel } from "./model.ts";

/** Weights for which the blended energy certainly has a minimum, a convex set; as CertainRange of the Python package. */
export interface CertainRange {
  /** Whether weights are in the range, without its bound. */
  holds(weights: readonly number[]): boolean;
}

/** Densities whose blends collapse (Material.collapses of the Python package); others have no cheap test. */
const COLLAPSING = ["stable-neo-hookean"];
const TERMS = 7; // per tet and pose: v A A^T (xx, yy, zz, yz, xz, xy) and 1 / v

/** Null where no test is known. */
export function certainRange({ blends, material, poses }: BlendingModel): CertainRange | null {
  if (blends.kind === "stars") return new FormRange(blends.dirichlet, poses.length);
  if (blends.kind !== "cubature" || !COLLAPSING.includes(material)) return null;
  return new TetRange(blends.corners, blends.weights.length, poses.length);
}

/** Where the weighted sum of quadratic forms is positive definite. */
export class FormRange implements CertainRange {
  readonly #forms: Float64Array;
  readonly #size: number;

  /** `forms` are symmetric matrices, one per pose, definite each. */
  constructor(forms: Float64Array, poses: number) {
    this.#forms = forms;
    this.#size = forms.length / poses;
  }

  holds(weights: readonly number[]): boolean {
    if (weights.every((w) => w >= 0)) return true;
    const sum = new Float64Array(this.#size);
    weights.forEach((w, pose) => {
      const form = this.#forms.subarray(this.#size * pose, this.#size * (pose + 1));
      for (let i = 0; i < sum.length; i++) sum[i] += w * form[i];
    });
    return isDefinite(sum);
  }
}

/** Where in all tets of the cubature M is positive definite, and alpha is. */
export class TetRange implements CertainRange {
  readonly #poses: number;
  readonly #terms: Float64Array;

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

/** Tested by Cholesky's factor, which overwrites the matrix. */
function isDefinite(A: Float64Array): boolean {
  const n = Math.sqrt(A.length);
  for (let i = 0; i < n; i++) {
    for (let j = 0; j <= i; j++) {
      let left = A[n * i + j];
      for (let k = 0; k < j; k++) left -= A[n * i + k] * A[n * j + k];
      if (j < i) A[n * i + j] = left / A[n * j + j];
      else if (left > 0) A[n * i + i] = Math.sqrt(left);
      else return false;
    }
  }
  return true;
}
