import { Object3D } from "three";

import type { Geometry } from "./geometry.ts";
import type { Graphics } from "./graphics.ts";
import type { Uniform } from "./program.ts";

/** Shaders in GLSL 3.00, without the line of the version, and how their fragments meet those before. */
export interface Material {
  readonly vertex: string;
  readonly fragment: string;
  readonly uniforms: Record<string, Uniform>;
  /** Drawn after all that is opaque, from far to near. */
  isTransparent: boolean;
  /** Whether nearer fragments hide it. */
  depthTest: boolean;
  /** Whether it hides what is farther away. */
  depthWrite: boolean;
  /** Whether it consists of lines. */
  readonly drawsLines: boolean;
}

/** An opaque material; `options` replace some of its parts. */
export function material(
  shaders: Pick<Material, "vertex" | "fragment" | "uniforms">,
  options: Partial<Omit<Material, "vertex" | "fragment" | "uniforms">> = {},
): Material {
  const opaque = { isTransparent: false, depthTest: true, depthWrite: true, drawsLines: false };
  return { ...shaders, ...opaque, ...options };
}

/** A geometry, or a range of its indices, in a material. */
export class Mesh extends Object3D {
  readonly geometry: Geometry;
  readonly material: Material;
  /** The first of the indices that are drawn, and their number. */
  readonly first: number;
  readonly drawn: number;
  castsShadow = false;

  constructor(geometry: Geometry, material: Material, first = 0, drawn = geometry.indices.length - first) {
    super();
    [this.geometry, this.material, this.first, this.drawn] = [geometry, material, first, drawn];
  }

  /** Draws it with its vertex shader, a fragment shader, and uniforms beside its own. */
  draw(graphics: Graphics, fragment: string, uniforms: Readonly<Record<string, Uniform>>): void {
    const { gl } = graphics;
    const { material, geometry } = this;
    const program = graphics.program(material.vertex, fragment);
    program.use();
    program.set(uniforms);
    program.set(material.uniforms);
    program.set({ model: { value: this.matrixWorld.elements } });
    geometry.bind(graphics);
    gl.drawElements(
      material.drawsLines ? gl.LINES : gl.TRIANGLES,
      this.drawn,
      gl.UNSIGNED_INT,
      4 * this.first,
    );
  }
}
