import {
  BufferAttribute,
  BufferGeometry,
  Color,
  type DataTexture,
  DoubleSide,
  IntType,
  Mesh,
  MeshDepthMaterial,
  MeshStandardMaterial,
  RGBADepthPacking,
  SRGBColorSpace,
} from "three";

import type { Appearance, OwnMaterial } from "../engine/index.ts";
import { creaseRings } from "./crease_rings.ts";
import { textureSize } from "./deformer.ts";
import { integers } from "./gpu_pass.ts";
import type { OwnLook } from "./own_look.ts";
import { deformedPoints, type SurfaceUniforms } from "./surface_shader.ts";

/** A surface in the user's own materials: its points follow the vertices that the shader gets as textures. */
export class OwnSurface {
  readonly mesh: Mesh<BufferGeometry, MeshStandardMaterial[]>;
  readonly #depth = new MeshDepthMaterial({ depthPacking: RGBADepthPacking, side: DoubleSide });
  readonly #pairs: DataTexture | null = null;

  constructor(look: OwnLook, base: Float32Array, uniforms: SurfaceUniforms) {
    const { appearance } = look;
    const geometry = geometryOf(appearance, base);
    if (appearance.creases) {
      const { ranges, pairs } = creaseRings(appearance);
      geometry.setAttribute("ownRing", wholeNumbers(ranges, 2));
      this.#pairs = integers(pairs, ...textureSize(pairs.length / 2));
      this.#pairs.needsUpdate = true;
    }
    const materials = appearance.materials.map((material) => materialOf(material, look));
    for (const material of [...materials, this.#depth]) deformedPoints(material, uniforms, this.#pairs);
    this.mesh = new Mesh(geometry, materials);
    this.mesh.customDepthMaterial = this.#depth;
    this.mesh.castShadow = this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  /** The textures belong to the look. */
  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.forEach((material) => material.dispose());
    this.#depth.dispose();
    this.#pairs?.dispose();
  }
}

function geometryOf({ points, triangles, coordinates, colors, materials }: Appearance, base: Float32Array) {
  const geometry = new BufferGeometry();
  const rest = new BufferAttribute(new Float32Array(3 * points.length), 3);
  points.forEach((vertex, point) => rest.set(base.subarray(3 * vertex, 3 * vertex + 3), 3 * point));
  geometry.setAttribute("position", rest);
  geometry.setAttribute("normal", rest); // never read; without one three.js shades flat
  geometry.setAttribute("ownVertex", wholeNumbers(points, 1));
  if (coordinates) geometry.setAttribute("uv", new BufferAttribute(coordinates, 2));
  if (colors) geometry.setAttribute("color", linearColors(colors));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  let start = 0;
  materials.forEach((material, k) => {
    geometry.addGroup(start, 3 * material.triangles, k);
    start += 3 * material.triangles;
  });
  return geometry;
}

function materialOf(
  { color, texture, roughness, alphaCutoff }: OwnMaterial,
  { appearance, textures }: OwnLook,
): MeshStandardMaterial {
  return new MeshStandardMaterial({
    color: new Color(...color),
    map: texture === null || !appearance.coordinates ? null : textures[texture],
    vertexColors: appearance.colors !== null,
    roughness,
    metalness: 0,
    alphaTest: alphaCutoff ?? 0,
    side: DoubleSide,
  });
}

function wholeNumbers(values: Int32Array<ArrayBuffer>, size: number): BufferAttribute {
  const attribute = new BufferAttribute(values, size);
  attribute.gpuType = IntType;
  return attribute;
}

function linearColors(bytes: Uint8Array): BufferAttribute {
  const linear = Float32Array.from(
    { length: 256 },
    (_, byte) => new Color().setRGB(byte / 255, 0, 0, SRGBColorSpace).r,
  );
  return new BufferAttribute(
    Float32Array.from(bytes, (byte) => linear[byte]),
    3,
  );
}
