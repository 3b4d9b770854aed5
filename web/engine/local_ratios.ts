const WIDTHS = [4, 2, 1, 0.5]; // in median distances to the nearest known frame
const GAIN = 0.02; // a narrower kernel must predict left-out ratios better by this share
const FAR = 1e-3; // the smallest weight of a frame, however far away

/** Ratios of true errors to an indicator, smoothed over frames, with bounds: a kernel mean of logarithms and the
 * jackknife+ around it. As snapspace/certificate/local_ratios.py, which names the sources. */
export class LocalRatios {
  readonly #frames: readonly Float64Array[];
  readonly #logs: readonly number[];
  #width = Infinity;
  #surprises: number[];

  /** Coordinates of the known frames one after the other, and as many positive ratios as frames. */
  constructor(coordinates: Float64Array, ratios: Float64Array) {
    const d = coordinates.length / ratios.length;
    this.#frames = Array.from(ratios, (_, i) => coordinates.subarray(d * i, d * (i + 1)));
    this.#logs = Array.from(ratios, Math.log);
    const gaps = this.#frames.map((own) => this.#frames.map((other) => distance(own, other)));
    const nearest = gaps.map((row, i) => Math.min(...row.filter((_, j) => j !== i)));
    const spacing = median(nearest);
    this.#surprises = this.#leftOut(gaps, Infinity);
    if (!(spacing > 0)) return;
    for (const width of WIDTHS) {
      const surprises = this.#leftOut(gaps, width * spacing);
      if (meanSize(surprises) < (1 - GAIN) * meanSize(this.#surprises))
        [this.#width, this.#surprises] = [width * spacing, surprises];
    }
  }

  /** The median ratio expected at a frame, and one that it exceeds with 1 - confidence; null if that takes more
   * known frames. */
  at(q: ArrayLike<number>, confidence: number): [number, number | null] {
    const count = this.#logs.length;
    const kernel = this.#frames.map((frame) => weight(distance(frame, q), this.#width));
    const all = sum(kernel.map((k, i) => k * this.#logs[i]));
    const whole = sum(kernel);
    // each prediction leaves out the frame whose surprise it gets
    const expected = kernel
      .map((k, i) => (all - k * this.#logs[i]) / (whole - k) + this.#surprises[i])
      .sort((a, b) => a - b);
    const rank = Math.ceil((count + 1) * confidence - 1e-9);
    return [Math.exp(median(expected)), rank > count ? null : Math.exp(expected[rank - 1])];
  }

  /** Logarithms less what all others predict for them. */
  #leftOut(gaps: readonly number[][], width: number): number[] {
    return this.#logs.map((log, i) => {
      const kernel = gaps[i].map((gap, j) => (j === i ? 0 : weight(gap, width)));
      return log - sum(kernel.map((k, j) => k * this.#logs[j])) / sum(kernel);
    });
  }
}

const weight = (gap: number, width: number) => Math.exp(-0.5 * (gap / width) ** 2) + FAR;
const sum = (values: readonly number[]) => values.reduce((total, value) => total + value, 0);
const meanSize = (values: readonly number[]) => sum(values.map(Math.abs)) / values.length;

function distance(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let squares = 0;
  for (let i = 0; i < a.length; i++) squares += (a[i] - b[i]) ** 2;
  return Math.sqrt(squares);
}

function median(values: readonly number[]): number {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}
