/** Shapes base + sum_i c_i modes_i of a surface.
 *
 * Modes are 16-bit integers with a scale each: the error of an entry is 1.5e-5 of the largest in its
 * mode, everywhere. Half floats would leave up to 2.4e-4 of the entry, too much at the tips. */
export interface ShapeSpace {
  readonly vertices: number;
  /** x0 y0 z0 x1 ... */
  readonly base: Float32Array<ArrayBuffer>;
  /** One mode after the other, each 3 * vertices. */
  readonly modes: Int16Array<ArrayBuffer>;
  readonly scales: Float32Array<ArrayBuffer>;
}

const LARGEST = 32767;

/** Modes, each 3 * vertices numbers, as 16-bit integers and scales. */
export function quantised(base: Float64Array, modes: Float64Array): ShapeSpace {
  const size = base.length;
  const count = modes.length / size;
  const integers = new Int16Array(modes.length);
  const scales = new Float32Array(count);
  for (let mode = 0; mode < count; mode++) {
    let most = 0;
    for (let i = mode * size; i < (mode + 1) * size; i++) most = Math.max(most, Math.abs(modes[i]));
    scales[mode] = most / LARGEST;
    if (!(most > 0)) continue;
    // by `most`, not by the rounded scale, so that no integer exceeds LARGEST
    for (let i = mode * size; i < (mode + 1) * size; i++)
      integers[i] = Math.round((modes[i] / most) * LARGEST);
  }
  return { vertices: size / 3, base: Float32Array.from(base), modes: integers, scales };
}

/** Writes base + sum_i c_i modes_i, with the first coefficients if there are fewer than modes. */
export function reconstruct(space: ShapeSpace, coefficients: ArrayLike<number>, shape: Float32Array): void {
  const { base, modes, scales } = space;
  shape.set(base);
  for (let mode = 0; mode < coefficients.length; mode++) {
    const factor = coefficients[mode] * scales[mode];
    if (factor === 0) continue;
    const start = mode * base.length;
    for (let i = 0; i < base.length; i++) shape[i] += factor * modes[start + i];
  }
}
