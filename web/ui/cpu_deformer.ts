import { reconstruct, vertexStrains, weightedNormals, type Rests, type ShapeSpace } from "../engine/index.ts";
import { Texture } from "../render/index.ts";
import { fromTexels, putRows, textureSize, type Deformer } from "./deformer.ts";

/** Positions and normals on the processor, where the graphics cannot draw into float textures. */
export class CpuDeformer implements Deformer {
  readonly positions: Texture;
  readonly normals: Texture;
  readonly width: number;
  readonly strains: Texture;
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
      new Texture({ format: "rgba32f", width, height, data: new Float32Array(4 * width * height) });
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
    putRows(this.#shape, this.positions);
    putRows(this.#normals, this.normals);
    if (this.#weights && this.#rests) {
      const found = vertexStrains(this.#rests, this.#weights, this.#shape, this.#faces);
      const texels = this.strains.data as Float32Array;
      found.forEach((strain, vertex) => (texels[4 * vertex] = strain));
      this.strains.changed();
    }
  }

  weigh(weights: readonly number[] | null): void {
    this.#weights = weights;
  }

  read(): Float32Array<ArrayBuffer> {
    return fromTexels(this.positions.data as Float32Array, this.#space);
  }

  readStrains(): Float32Array {
    return fromTexels(this.strains.data as Float32Array, this.#space).filter((_, i) => i % 3 === 0);
  }

  dispose(): void {
    this.strains.dispose();
    this.positions.dispose();
    this.normals.dispose();
  }
}
