import { Group, type Color, type Ray } from "three";

import {
  reconstruct,
  ShapePicker,
  StrainScale,
  type Hit,
  type Rests,
  type RigidMap,
  type ShapeSpace,
} from "../engine/index.ts";
import { Geometry, Mesh, type Attribute, type Graphics, type Texture } from "../render/index.ts";
import { CpuDeformer } from "./cpu_deformer.ts";
import { textureSize, type Deformer } from "./deformer.ts";
import { edgesOf } from "./edges.ts";
import { encloses } from "./encloses.ts";
import { GpuDeformer } from "./gpu_deformer.ts";
import { integers } from "./gpu_pass.ts";
import { Occlusion } from "./occlusion.ts";
import type { OwnLook } from "./own_look.ts";
import { OwnSurface } from "./own_surface.ts";
import { copyRows, sharpEdges } from "./sharp_edges.ts";
import { clay, wires } from "./surface_materials.ts";
import type { SurfaceUniforms } from "./surface_shader.ts";

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
  readonly #graphics: Graphics;
  readonly #deformer: Deformer;
  readonly #colors: Attribute;
  /** With sharp edges: the vertices of the points that are drawn, and pairs of vertices of the faces around them. */
  readonly #points: Int32Array | null;
  readonly #pairs: Texture | null;
  readonly solid: Mesh;
  #wires: Mesh | null = null;
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
    graphics: Graphics,
    space: ShapeSpace,
    faces: Uint32Array<ArrayBuffer>,
    diagonal: number,
    forceCpu = false,
    rests: Rests | null = null,
    look: OwnLook | null = null,
  ) {
    this.#graphics = graphics;
    this.look = look;
    this.space = space;
    this.faces = faces;
    this.onGpu = !forceCpu && GpuDeformer.supports(graphics, space);
    this.#deformer = this.onGpu
      ? new GpuDeformer(graphics, space, faces, rests)
      : new CpuDeformer(space, faces, rests);
    this.#rests = rests;
    const sharp = sharpEdges(space.base, faces);
    this.#points = sharp?.points ?? null;
    const places = new Float32Array(sharp ? 3 * sharp.points.length : space.base.length);
    places.set(space.base);
    if (sharp) copyRows(places, sharp.points, space.vertices);
    this.#colors = { data: new Float32Array(places.length).fill(1), size: 3 };
    this.#pairs = sharp && integers(sharp.pairs, ...textureSize(sharp.pairs.length / 2));
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
      isShadowed: { value: true },
      encloses: { value: encloses(faces, space.base) },
      opacity: { value: 1 },
    };
    const attributes = {
      position: { data: places, size: 3 },
      vertexColor: this.#colors,
      ...(sharp && {
        ownVertex: { data: sharp.points, size: 1 },
        ownRing: { data: sharp.ranges, size: 2 },
      }),
    };
    const geometry = new Geometry(attributes, sharp?.triangles ?? faces);
    this.solid = new Mesh(geometry, clay(this.#uniforms, this.#pairs));
    this.solid.castsShadow = true;
    this.#own = look && new OwnSurface(look, this.#uniforms, space.base);
    this.object.add(this.solid, ...(this.#own ? [this.#own.object] : []));
    this.object.matrixAutoUpdate = false;
  }

  /** Shows the shape with these coefficients; the others are zero. */
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

  /** The coefficients, and the share of the path to the goal. */
  get blended(): readonly [ArrayLike<number>, number] {
    return [this.#coefficients, this.#share];
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
    if (visible && !this.#wires) {
      this.#wires = new Mesh(new Geometry({}, edgesOf(this.faces)), wires(this.#uniforms));
      this.object.add(this.#wires);
    }
    if (this.#wires) this.#wires.visible = visible;
  }

  /** Whether less of the light from all sides reaches creases; ignored where `Occlusion` is not supported. */
  set occluded(on: boolean) {
    this.#occlusion?.dispose();
    this.#occlusion =
      on && Occlusion.supports(this.#graphics)
        ? new Occlusion(this.#graphics, this.#deformer, this.space.base, this.faces)
        : null;
    this.#occlusion?.update();
    const { shownOcclusion, isOccluded } = this.#uniforms;
    shownOcclusion.value = this.#occlusion?.texture ?? this.#deformer.normals;
    isOccluded.value = this.#occlusion !== null;
  }

  /** Sets the rigid motion that carries the surface. */
  carry({ rotation: R, shift: t }: RigidMap): void {
    const { matrix } = this.object;
    matrix.set(R[0], R[1], R[2], t[0], R[3], R[4], R[5], t[1], R[6], R[7], R[8], t[2], 0, 0, 0, 1);
    this.object.matrixWorldNeedsUpdate = true;
  }

  /** Whether shadows fall on it. */
  set shadowed(on: boolean) {
    this.#uniforms.isShadowed.value = on;
  }

  get colors(): Colors {
    return COLORS[this.#uniforms.shownColors.value];
  }

  set colors(colors: Colors) {
    this.#uniforms.shownColors.value = COLORS.indexOf(colors);
    if (this.#own) this.#own.object.visible = colors === "material";
    this.solid.visible = !this.#own?.object.visible;
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
    this.wireframe = other.#wires?.visible ?? false;
    this.shadowed = other.#uniforms.isShadowed.value;
    this.colors = other.colors;
    this.strainEnd = other.#uniforms.strainEnd.value;
    this.occluded = other.#occlusion !== null;
  }

  /** A colour for every vertex. */
  paint(color: (vertex: number) => Color): void {
    for (let vertex = 0; vertex < this.space.vertices; vertex++) this.#put(vertex, color(vertex));
    this.#painted();
  }

  /** One colour for some vertices. */
  paintSome(vertices: Iterable<number>, color: Color): void {
    for (const vertex of vertices) this.#put(vertex, color);
    this.#painted();
  }

  #put(vertex: number, { r, g, b }: Color): void {
    const { data } = this.#colors;
    [data[3 * vertex], data[3 * vertex + 1], data[3 * vertex + 2]] = [r, g, b];
  }

  /** Gives all sides of sharp edges the colours of their vertices. */
  #painted(): void {
    if (this.#points) copyRows(this.#colors.data, this.#points, this.space.vertices);
    this.solid.geometry.changed("vertexColor");
  }

  dispose(): void {
    this.#deformer.dispose();
    this.#pairs?.dispose();
    this.#occlusion?.dispose();
    this.#own?.dispose();
    this.solid.geometry.dispose();
    this.#wires?.geometry.dispose();
  }
}
