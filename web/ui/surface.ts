import {
  BufferAttribute,
  BufferGeometry,
  Group,
  Mesh,
  type Color,
  type Material,
  type Ray,
  type WebGLRenderer,
} from "three";

import {
  reconstruct,
  ShapePicker,
  StrainScale,
  type Hit,
  type Rests,
  type RigidMap,
  type ShapeSpace,
} from "../engine/index.ts";
import { CpuDeformer } from "./cpu_deformer.ts";
import type { Deformer } from "./deformer.ts";
import { GpuDeformer } from "./gpu_deformer.ts";
import { Occlusion } from "./occlusion.ts";
import type { OwnLook } from "./own_look.ts";
import { OwnSurface } from "./own_surface.ts";
import { clay, depths, wires } from "./surface_materials.ts";
import { deformedBy, type SurfaceUniforms } from "./surface_shader.ts";

/** What its colours show: the paint of its vertices, the user's own materials, or a number on a ramp. */
export type Colors = "own" | "displacement" | "strain" | "material";
const COLORS: readonly Colors[] = ["own", "displacement", "strain", "material"];

/** Displacements, over the diagonal, at which their colours end. */
export const FARTHEST = 0.25;

/** A shaded surface whose shape is given by coefficients. */
export class Surface {
  /** Carries the surface: its matrix is the shape's rigid motion. */
  readonly object = new Group();
  readonly space: ShapeSpace;
  readonly faces: Uint32Array<ArrayBuffer>;
  readonly onGpu: boolean;
  /** The user's own materials. */
  readonly look: OwnLook | null;
  readonly #renderer: WebGLRenderer;
  readonly #deformer: Deformer;
  readonly #geometry = new BufferGeometry();
  readonly #materials: readonly Material[];
  readonly #solid: Mesh;
  readonly #wires: Mesh;
  readonly #own: OwnSurface | null;
  readonly #uniforms: SurfaceUniforms;
  readonly #rests: Rests | null;
  #picker: ShapePicker | null = null;
  #coefficients: ArrayLike<number> = [];
  #goal: Float32Array | null = null;
  #share = 0;
  #weights: readonly number[] = [1];
  #scale: StrainScale | null = null;
  #occlusion: Occlusion | null = null;

  /** `forceCpu` computes as in browsers that cannot draw into float textures; `look` is shown for the colours
   * "material". */
  constructor(
    renderer: WebGLRenderer,
    space: ShapeSpace,
    faces: Uint32Array<ArrayBuffer>,
    diagonal: number,
    forceCpu = false,
    rests: Rests | null = null,
    look: OwnLook | null = null,
  ) {
    this.#renderer = renderer;
    this.look = look;
    this.space = space;
    this.faces = faces;
    this.onGpu = !forceCpu && GpuDeformer.supports(renderer, space);
    this.#deformer = this.onGpu
      ? new GpuDeformer(renderer, space, faces, rests)
      : new CpuDeformer(space, faces, rests);
    this.#rests = rests;
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
      shownStrains: { value: this.#deformer.normals },
      shownColors: { value: 0 },
      displacementEnd: { value: FARTHEST * diagonal },
      strainEnd: { value: 1 },
      shownOcclusion: { value: this.#deformer.normals },
      isOccluded: { value: false },
    };
    const [solid, depth, edges] = (this.#materials = [clay(), depths(), wires()] as const);
    for (const material of this.#materials) deformedBy(material, this.#uniforms);
    this.#solid = new Mesh(this.#geometry, solid);
    this.#solid.customDepthMaterial = depth;
    this.#solid.castShadow = true;
    this.#solid.receiveShadow = true;
    this.#wires = new Mesh(this.#geometry, edges);
    this.#wires.visible = false;
    for (const mesh of [this.#solid, this.#wires]) mesh.frustumCulled = false;
    this.#own = look && new OwnSurface(look, space.base, this.#uniforms);
    this.object.add(this.#solid, this.#wires, ...(this.#own ? [this.#own.mesh] : []));
    this.object.matrixAutoUpdate = false;
  }

  /** Takes the shape with these coefficients; the others are zero. */
  show(coefficients: ArrayLike<number>): void {
    this.#coefficients = coefficients;
    this.#share = 0;
    this.#picker?.show(coefficients);
    this.refresh();
  }

  /** The shape to blend to, 3 numbers per vertex. */
  set goal(positions: Float32Array) {
    this.#goal = positions;
    this.#deformer.goal = positions;
    if (this.#picker) this.#picker.goal = positions;
  }

  /** Shows the shape at a share of the path to the goal. */
  blend(share: number): void {
    this.#share = share;
    this.#picker?.show(this.#coefficients, share);
    this.refresh();
  }

  /** Computes the shape, also what was lost on the graphics processor. */
  refresh(): void {
    this.#deformer.update(this.#coefficients, this.#share);
    this.#occlusion?.update();
  }

  /** The shape before its rigid motion, computed here. */
  positions(): Float32Array {
    const shape = new Float32Array(this.space.base.length);
    reconstruct(this.space, this.#coefficients, shape);
    return shape;
  }

  /** Where a ray hits the shape, before its rigid motion and as it is drawn. The first call takes some milliseconds. */
  pick({ origin, direction }: Ray): Hit | null {
    if (!this.#picker) {
      this.#picker = new ShapePicker(this.space, this.faces);
      if (this.#goal) this.#picker.goal = this.#goal;
      this.#picker.show(this.#coefficients, this.#share);
    }
    return this.#picker.pick(origin.toArray(), direction.toArray());
  }

  /** Forgets what was computed for rays, as after another shape. */
  forgetPicks(): void {
    this.#picker?.show(this.#coefficients, this.#share);
  }

  /** The shape before its rigid motion, as the vertex shader gets it. */
  shown(): Float32Array<ArrayBuffer> {
    return this.#deformer.read();
  }

  set wireframe(visible: boolean) {
    this.#wires.visible = visible;
  }

  /** Draws it pale and without a shadow. */
  fade(opacity: number): void {
    const [clay] = this.#materials;
    Object.assign(clay, { transparent: true, opacity, depthWrite: false });
    for (const mesh of this.#meshes) mesh.castShadow = mesh.receiveShadow = false;
  }

  /** Whether less of the light from all sides reaches creases; ignored where `Occlusion` is not supported. */
  set occluded(on: boolean) {
    this.#occlusion?.dispose();
    this.#occlusion =
      on && Occlusion.supports(this.#renderer)
        ? new Occlusion(this.#renderer, this.#deformer, this.space.base, this.faces)
        : null;
    this.#occlusion?.update();
    const { shownOcclusion, isOccluded } = this.#uniforms;
    shownOcclusion.value = this.#occlusion?.texture ?? this.#deformer.normals;
    isOccluded.value = this.#occlusion !== null;
  }

  /** Takes a rigid motion along. */
  carry({ rotation: R, shift: t }: RigidMap): void {
    const { matrix } = this.object;
    matrix.set(R[0], R[1], R[2], t[0], R[3], R[4], R[5], t[1], R[6], R[7], R[8], t[2], 0, 0, 0, 1);
    this.object.matrixWorldNeedsUpdate = true;
  }

  /** Whether shadows fall on it. */
  set shadowed(on: boolean) {
    for (const mesh of this.#meshes) mesh.receiveShadow = on;
  }

  get colors(): Colors {
    return COLORS[this.#uniforms.shownColors.value];
  }

  set colors(colors: Colors) {
    this.#uniforms.shownColors.value = COLORS.indexOf(colors);
    if (this.#own) this.#own.mesh.visible = colors === "material";
    this.#solid.visible = !this.#own?.mesh.visible;
    this.#deformer.weigh(colors === "strain" ? this.#weights : null);
    this.#deformer.update(this.#coefficients, this.#share);
    this.#uniforms.shownStrains.value = this.#deformer.strains ?? this.#deformer.normals;
  }

  /** Weights of the shapes at rest that strains are relative to; one of one by default. */
  set weights(weights: readonly number[]) {
    this.#weights = weights;
    if (this.colors === "strain") this.#deformer.weigh(weights);
  }

  /** Where a scale of strains should end for the present shape. */
  strainScale(): number {
    if (!this.#rests) return 1;
    this.#scale ??= new StrainScale(this.space, this.#rests, this.faces);
    this.#scale.look(this.#coefficients, this.#weights);
    return this.#scale.end;
  }

  /** Where the colours of strains end. */
  set strainEnd(end: number) {
    this.#uniforms.strainEnd.value = end;
  }

  /** Strains as the vertex shader gets them. */
  strains(): Float32Array {
    return this.#deformer.readStrains();
  }

  /** Looks as another one does. */
  lookAs(other: Surface): void {
    this.#wires.visible = other.#wires.visible;
    this.#solid.receiveShadow = other.#solid.receiveShadow;
    this.colors = other.colors;
    this.strainEnd = other.#uniforms.strainEnd.value;
    this.occluded = other.#occlusion !== null;
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

  /** One colour for some vertices. */
  paintSome(vertices: Iterable<number>, { r, g, b }: Color): void {
    const colors = this.#geometry.getAttribute("color") as BufferAttribute;
    for (const vertex of vertices) colors.setXYZ(vertex, r, g, b);
    colors.needsUpdate = true;
  }

  /** The colour that a vertex was painted in. */
  colorOf(vertex: number): [number, number, number] {
    const { array } = this.#geometry.getAttribute("color");
    return [array[3 * vertex], array[3 * vertex + 1], array[3 * vertex + 2]];
  }

  get #meshes(): Mesh[] {
    return this.#own ? [this.#solid, this.#own.mesh] : [this.#solid];
  }

  dispose(): void {
    this.#deformer.dispose();
    this.#occlusion?.dispose();
    this.#own?.dispose();
    this.#geometry.dispose();
    this.#materials.forEach((material) => material.dispose());
  }
}
