import { DataTexture, FloatType, RGBAFormat } from "three";

import { reconstruct, vertexStrains, type Rests, type ShapeSpace } from "../engine/index.ts";
import { asTexels, fromTexels, textureSize, type Deformer } from "./deformer.ts";

/** Positions and normals on the processor, where the graphics cannot draw into float textures. */
export class CpuDeformer implements Deformer {
  readonly positions: DataTexture;
  readonly normals: DataTexture;
  readonly width: number;
  readonly strains: DataTexture;
  readonly #space: ShapeSpace;
  readonly #rests: Rests | null;
  readonly #faces: Uint32Array;
  readonly #shape: Float32Array;
  readonly #normals: Float32Array;
  #goal: Float32Array;
  #weights: readonly number[] | null = null;

  constructor(space: ShapeSpace, faces: Uint32Array, rests: Rests | null = null) {
    const [width, height] = textureSize(space.vertices);
    const texture = () =>
      new DataTexture(new Float32Array(4 * width * height), width, height, RGBAFormat, FloatType);
    this.#space = space;
    this.#rests = rests;
    this.#faces = faces;
    this.#goal = space.base;
    this.width = width;
    this.positions = texture();
    this.normals = texture();
    this.strains = texture();
    this.#shape = new Float32Array(3 * space.vertices);
    this.#normals = new Float32Array(3 * space.vertices);
    this.update([]);
  }

  set goal(positions: Float32Array) {
    this.#goal = positions;
  }

  update(coefficients: ArrayLike<number>, share = 0): void {
    reconstruct(this.#space, coefficients, this.#shape);
    if (share > 0)
      for (let i = 0; i < this.#shape.length; i++) this.#shape[i] += share * (this.#goal[i] - this.#shape[i]);
    weightedNormals(this.#shape, this.#faces, this.#normals);
    asTexels(this.#shape, this.positions.image.data as Float32Array);
    asTexels(this.#normals, this.normals.image.data as Float32Array);
    this.positions.needsUpdate = true;
    this.normals.needsUpdate = true;
    if (this.#weights && this.#rests) {
      const found = vertexStrains(this.#rests, this.#weights, this.#shape, this.#faces);
      const texels = this.strains.image.data as Float32Array;
      found.forEach((strain, vertex) => (texels[4 * vertex] = strain));
      this.strains.needsUpdate = true;
    }
  }

  weigh(weights: readonly number[] | null): void {
    this.#weights = weights;
  }

  read(): Float32Array {
    return fromTexels(this.positions.image.data as Float32Array, this.#space);
  }

  readStrains(): Float32Array {
    return fromTexels(this.strains.image.data as Float32Array, this.#space).filter((_, i) => i % 3 === 0);
  }

  dispose(): void {
    this.strains.dispose();
    this.positions.dispose();
    this.normals.dispose();
  }
}

/** Sums of the faces' normals, weighted by area; not of length one. */
function weightedNormals(shape: Float32Array, faces: Uint32Array, normals: Float32Array): void {
  normals.fill(0);
  for (let f = 0; f < faces.length; f += 3) {
    const [a, b, c] = [3 * faces[f], 3 * faces[f + 1], 3 * faces[f + 2]];
    const [ux, uy, uz] = [shape[b] - shape[a], shape[b + 1] - shape[a + 1], shape[b + 2] - shape[a + 2]];
    const [vx, vy, vz] = [shape[c] - shape[a], shape[c + 1] - shape[a + 1], shape[c + 2] - shape[a + 2]];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) {
      normals[corner] += x;
      normals[corner + 1] += y;
      normals[corner + 2] += z;
    }
  }
}
