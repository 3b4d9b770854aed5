import type { ShapeSpace } from "../engine/index.ts";
import type { Texture } from "../render/index.ts";

/** Turns coefficients into positions and normals of a surface's vertices, as textures for the vertex shader. */
export interface Deformer {
  /** One texel per vertex, row by row: x, y, z, and 1. */
  readonly positions: Texture;
  readonly normals: Texture;
  /** Texels in a row. */
  readonly width: number;
  /** Strains, in the red of each texel; null until `weigh` asks for them. */
  readonly strains: Texture | null;
  /** The shape to blend to, 3 numbers per vertex. */
  goal: Float32Array;
  /** Computes the shape with these coefficients, or the one at a share of the path from there to the goal. */
  update(coefficients: ArrayLike<number>, share?: number): void;
  /** Sets the weights of the shapes at rest, and computes strains from then on; null ends that. */
  weigh(weights: readonly number[] | null): void;
  /** The positions as the vertex shader gets them, 3 per vertex. */
  read(): Float32Array<ArrayBuffer>;
  /** The strains as the vertex shader gets them. */
  readStrains(): Float32Array;
  dispose(): void;
}

/** Width and height of a texture with a texel for each of `count` items. */
export function textureSize(count: number): [number, number] {
  const width = 2 ** Math.ceil(Math.log2(Math.max(Math.sqrt(count), 1)));
  return [width, Math.max(Math.ceil(count / width), 1)];
}

/** Rows of 3 numbers as texels of 4. */
export function asTexels(rows: ArrayLike<number>, texels: Float32Array): void {
  for (let from = 0, to = 0; from < rows.length; from += 3, to += 4) {
    texels[to] = rows[from];
    texels[to + 1] = rows[from + 1];
    texels[to + 2] = rows[from + 2];
    texels[to + 3] = 1;
  }
}

/** Puts rows of 3 numbers into a texture of floats. */
export function putRows(rows: ArrayLike<number>, texture: Texture): void {
  asTexels(rows, texture.data as Float32Array);
  texture.changed();
}

/** Texels of 4 as rows of 3 numbers. */
export function fromTexels(texels: Float32Array, space: ShapeSpace): Float32Array<ArrayBuffer> {
  const rows = new Float32Array(3 * space.vertices);
  for (let i = 0; i < rows.length; i++) rows[i] = texels[4 * Math.floor(i / 3) + (i % 3)];
  return rows;
}
