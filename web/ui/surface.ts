import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshDepthMaterial,
  MeshStandardMaterial,
  RGBADepthPacking,
  type Color,
  type Material,
  type WebGLRenderer,
} from "three";

import { reconstruct, type ShapeSpace } from "../engine/index.ts";
import { CpuDeformer } from "./cpu_deformer.ts";
import type { Deformer } from "./deformer.ts";
import { GpuDeformer } from "./gpu_deformer.ts";
import { deformedBy, type SurfaceUniforms } from "./surface_shader.ts";

/** A shaded surface whose shape is given by coefficients. */
export class Surface {
  /** Carries the surface: its matrix is the shape's rigid motion. */
  readonly object = new Group();
  readonly space: ShapeSpace;
  readonly faces: Uint32Array<ArrayBuffer>;
  readonly onGpu: boolean;
  readonly #deformer: Deformer;
  readonly #geometry = new BufferGeometry();
  readonly #materials: Material[];
  readonly #solid: Mesh;
  readonly #wires: Mesh;
  readonly #uniforms: SurfaceUniforms;
  readonly #cpu: Float32Array;
  #coefficients: ArrayLike<number> = [];
  #cpuIsFresh = false;

  /** `forceCpu` takes the way of browsers that cannot draw into float textures. */
  constructor(
    renderer: WebGLRenderer,
    space: ShapeSpace,
    faces: Uint32Array<ArrayBuffer>,
    diagonal: number,
    forceCpu = false,
  ) {
    this.space = space;
    this.faces = faces;
    this.onGpu = !forceCpu && GpuDeformer.supports(renderer, space);
    this.#deformer = this.onGpu ? new GpuDeformer(renderer, space, faces) : new CpuDeformer(space, faces);
    this.#cpu = new Float32Array(3 * space.vertices);
    const base = new BufferAttribute(space.base, 3);
    this.#geometry.setAttribute("position", base);
    this.#geometry.setAttribute("normal", base); // never read; without one three.js shades flat
    this.#geometry.setAttribute(
      "color",
      new BufferAttribute(new Float32Array(3 * space.vertices).fill(1), 3),
    );
    this.#geometry.setIndex(new BufferAttribute(faces, 1));
    this.#uniforms = {
      shownPositions: { value: this.#deformer.positions },
      shownNormals: { value: this.#deformer.normals },
      shownWidth: { value: this.#deformer.width },
      displacementColors: { value: 0 },
      displacementUnit: { value: 4 / diagonal },
    };
    const clay = new MeshStandardMaterial({
      vertexColors: true,
      roughness: 0.58,
      metalness: 0,
      side: DoubleSide,
    });
    const depth = new MeshDepthMaterial({ depthPacking: RGBADepthPacking, side: DoubleSide });
    const wires = new MeshBasicMaterial({
      wireframe: true,
      color: 0x10141c,
      transparent: true,
      opacity: 0.22,
    });
    wires.polygonOffset = true;
    wires.polygonOffsetFactor = -1;
    this.#materials = [clay, depth, wires];
    for (const material of this.#materials) deformedBy(material, this.#uniforms);
    this.#solid = new Mesh(this.#geometry, clay);
    this.#solid.customDepthMaterial = depth;
    this.#solid.castShadow = true;
    this.#solid.receiveShadow = true;
    this.#wires = new Mesh(this.#geometry, wires);
    this.#wires.visible = false;
    for (const mesh of [this.#solid, this.#wires]) mesh.frustumCulled = false;
    this.object.add(this.#solid, this.#wires);
    this.object.matrixAutoUpdate = false;
  }

  /** Takes the shape with these coefficients; the others are zero. */
  show(coefficients: ArrayLike<number>): void {
    this.#coefficients = coefficients;
    this.#cpuIsFresh = false;
    this.#deformer.update(coefficients);
  }

  /** The shape before its rigid motion, computed here: for picking. */
  positions(): Float32Array {
    if (!this.#cpuIsFresh) reconstruct(this.space, this.#coefficients, this.#cpu);
    this.#cpuIsFresh = true;
    return this.#cpu;
  }

  /** The shape before its rigid motion, as the vertex shader gets it. */
  shown(): Float32Array {
    return this.#deformer.read();
  }

  set wireframe(visible: boolean) {
    this.#wires.visible = visible;
  }

  /** Whether shadows fall on it. */
  set shadowed(on: boolean) {
    this.#solid.receiveShadow = on;
  }

  set displacementColors(on: boolean) {
    this.#uniforms.displacementColors.value = on ? 1 : 0;
  }

  /** Looks as another one does. */
  lookAs(other: Surface): void {
    this.#wires.visible = other.#wires.visible;
    this.#solid.receiveShadow = other.#solid.receiveShadow;
    this.#uniforms.displacementColors.value = other.#uniforms.displacementColors.value;
  }

  /** A colour for every vertex. */
  paint(color: (vertex: number) => Color): void {
    const colors = this.#geometry.getAttribute("color") as BufferAttribute;
    for (let vertex = 0; vertex < this.space.vertices; vertex++) {
      const { r, g, b } = color(vertex);
      colors.setXYZ(vertex, r, g, b);
    }
    colors.needsUpdate = true;
  }

  dispose(): void {
    this.#deformer.dispose();
    this.#geometry.dispose();
    this.#materials.forEach((material) => material.dispose());
  }
}
