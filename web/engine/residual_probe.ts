import { hatGradients } from "./displacement_gradients.ts";
import type { Estimator } from "./estimator.ts";
import type { Material } from "./model.ts";

/** The full objective's gradient at the vertices of a sample: exact there, and its cost does not grow with the
 * mesh. As snapspace/certificate/residual_probe.py. */
export class ResidualProbe {
  readonly #estimator: Estimator;
  readonly #material: Material;
  /** For each shape at rest: of each tet the gradients of hat functions 1, 2 and 3, and the volume. */
  readonly #hats: readonly Float64Array[];
  readonly #shape: Float64Array;
  readonly #gradient: Float64Array;

  constructor(estimator: Estimator, material: Material) {
    this.#estimator = estimator;
    this.#material = material;
    this.#hats = estimator.rests.map((rest) => hatsOf(rest, estimator.tets));
    this.#shape = new Float64Array(estimator.base.length);
    this.#gradient = new Float64Array(estimator.base.length);
  }

  /** Estimate of sqrt(g^T D^-1 g) at tau + U q. `state`: offsets of the handles, 12 each, or weights of the poses. */
  norm(q: ArrayLike<number>, state: ArrayLike<number>): number {
    const { base, modes, rests, places, weights } = this.#estimator;
    const shape = this.#shape;
    shape.set(base);
    for (let mode = 0; mode < q.length; mode++)
      for (let i = 0; i < shape.length; i++) shape[i] += q[mode] * modes[mode * shape.length + i];
    this.#gradient.fill(0);
    rests.forEach((rest, k) => this.#addElastic(rest, this.#hats[k], rests.length > 1 ? state[k] : 1));
    this.#addPins(state);
    let sum = 0;
    places.forEach((corner, i) => {
      const [x, y, z] = this.#gradient.subarray(3 * corner, 3 * corner + 3);
      sum += weights[i] * (x * x + y * y + z * z);
    });
    return Math.sqrt(sum);
  }

  #addElastic(rest: Float64Array, hats: Float64Array, weight: number): void {
    const { tets } = this.#estimator;
    const { lam, mu } = this.#material;
    const [shape, gradient] = [this.#shape, this.#gradient];
    const [G, S, P] = [new Float64Array(9), new Float64Array(9), new Float64Array(9)];
    for (let t = 0, h = 0; t < tets.length; t += 4, h += 10) {
      const o = 3 * tets[t];
      G.fill(0);
      for (let corner = 1; corner < 4; corner++) {
        const c = 3 * tets[t + corner];
        for (let a = 0; a < 3; a++) {
          const u = shape[c + a] - rest[c + a] - (shape[o + a] - rest[o + a]);
          for (let b = 0; b < 3; b++) G[3 * a + b] += u * hats[h + 3 * corner - 3 + b];
        }
      }
      secondStress(G, lam, mu, S);
      firstStress(G, S, P);
      const volume = weight * hats[h + 9];
      for (let corner = 1; corner < 4; corner++) {
        const c = 3 * tets[t + corner];
        const n = h + 3 * corner - 3;
        for (let a = 0; a < 3; a++) {
          const force =
            volume * (P[3 * a] * hats[n] + P[3 * a + 1] * hats[n + 1] + P[3 * a + 2] * hats[n + 2]);
          gradient[c + a] += force;
          gradient[o + a] -= force;
        }
      }
    }
  }

  #addPins(offsets: ArrayLike<number>): void {
    const { rests, pins } = this.#estimator;
    pins.corners.forEach((corner, pin) => {
      const [x, y, z] = pins.arms.subarray(3 * pin, 3 * pin + 3);
      for (let a = 0; a < 3; a++) {
        const row = 12 * pins.handles[pin] + 4 * a;
        const wanted = offsets[row] * x + offsets[row + 1] * y + offsets[row + 2] * z + offsets[row + 3];
        const i = 3 * corner + a;
        this.#gradient[i] += pins.pulls[pin] * (this.#shape[i] - rests[0][i] - wanted);
      }
    });
  }
}

function hatsOf(rest: Float64Array, tets: Int32Array): Float64Array {
  const hats = new Float64Array((10 * tets.length) / 4);
  for (let t = 0; t < tets.length / 4; t++) {
    const corners = tets.subarray(4 * t, 4 * t + 4);
    const gradients = hatGradients(rest, corners);
    hats.set(gradients, 10 * t);
    hats[10 * t + 9] = Math.abs(volumeOf(gradients));
  }
  return hats;
}

/** Of a tet whose hat functions 1, 2 and 3 have these gradients: their determinant is 1 / (6 volume). */
function volumeOf([ux, uy, uz, vx, vy, vz, wx, wy, wz]: number[]): number {
  return 1 / (6 * (ux * (vy * wz - vz * wy) + uy * (vz * wx - vx * wz) + uz * (vx * wy - vy * wx)));
}

/** S = 2 mu E + lam tr(E) I with E = (G + G^T + G^T G) / 2. */
function secondStress(G: Float64Array, lam: number, mu: number, S: Float64Array): void {
  for (let a = 0; a < 3; a++)
    for (let b = a; b < 3; b++) {
      const product = G[a] * G[b] + G[3 + a] * G[3 + b] + G[6 + a] * G[6 + b];
      S[3 * a + b] = S[3 * b + a] = mu * (G[3 * a + b] + G[3 * b + a] + product);
    }
  const pressure = ((S[0] + S[4] + S[8]) / (2 * mu)) * lam;
  for (const i of [0, 4, 8]) S[i] += pressure;
}

/** P = (I + G) S. */
function firstStress(G: Float64Array, S: Float64Array, P: Float64Array): void {
  for (let a = 0; a < 3; a++)
    for (let b = 0; b < 3; b++)
      P[3 * a + b] = S[3 * a + b] + G[3 * a] * S[b] + G[3 * a + 1] * S[3 + b] + G[3 * a + 2] * S[6 + b];
}
