import { Color, Group, SRGBColorSpace } from "three";

import type { Appearance, OwnMaterial } from "../engine/index.ts";
import { Geometry, Mesh, type Material, type Texture } from "../render/index.ts";
import { creaseRings } from "./crease_rings.ts";
import { textureSize } from "./deformer.ts";
import { encloses } from "./encloses.ts";
import { integers } from "./gpu_pass.ts";
import type { OwnLook } from "./own_look.ts";
import { litSurface } from "./surface_materials.ts";
import type { Part, SurfaceUniforms } from "./surface_shader.ts";

/** A surface in the user's own materials: its points follow the vertices that the shader gets as textures. */
export class OwnSurface {
  /** A mesh for each material. */
  readonly object = new Group();
  readonly #geometry: Geometry;
  readonly #pairs: Texture | null;

  /** `shape` is where the surface's vertices are at rest. */
  constructor(look: OwnLook, uniforms: SurfaceUniforms, shape: Float32Array) {
    const { appearance } = look;
    const { points, triangles } = appearance;
    const corners = triangles.map((point) => points[point]);
    uniforms = { ...uniforms, encloses: { value: encloses(corners, shape) } };
    const rings = appearance.creases ? creaseRings(appearance) : null;
    this.#geometry = geometryOf(appearance, rings?.ranges ?? null);
    this.#pairs = rings && integers(rings.pairs, ...textureSize(rings.pairs.length / 2));
    let start = 0;
    for (const own of appearance.materials) {
      const count = 3 * own.triangles;
      const mesh = new Mesh(this.#geometry, materialOf(own, look, this.#pairs, uniforms), start, count);
      mesh.castsShadow = true;
      this.object.add(mesh);
      start += count;
    }
    this.object.visible = false;
  }

  /** The textures belong to the look. */
  dispose(): void {
    this.#geometry.dispose();
    this.#pairs?.dispose();
  }
}

function geometryOf(
  { points, triangles, coordinates, colors }: Appearance,
  ranges: Int32Array<ArrayBuffer> | null,
): Geometry {
  return new Geometry(
    {
      ownVertex: { data: points, size: 1 },
      ...(ranges && { ownRing: { data: ranges, size: 2 } }),
      ...(coordinates && { uv: { data: coordinates, size: 2 } }),
      ...(colors && { vertexColor: { data: linear(colors), size: 3 } }),
    },
    triangles,
  );
}

function materialOf(
  { color, texture, roughness, alphaCutoff }: OwnMaterial,
  { appearance, textures }: OwnLook,
  pairs: Texture | null,
  uniforms: SurfaceUniforms,
): Material {
  const picture = texture === null || !appearance.coordinates ? null : textures[texture];
  const parts: Part[] = ["POINTS"];
  if (pairs) parts.push("CREASED");
  if (picture) parts.push("PICTURE");
  if (appearance.colors) parts.push("COLORS");
  const looks = { color: new Color(...color), roughness, alphaCutoff: alphaCutoff ?? 0, picture, pairs };
  return litSurface(uniforms, looks, parts);
}

/** Colours in sRGB as numbers that are linear in light. */
function linear(bytes: Uint8Array): Float32Array<ArrayBuffer> {
  const levels = Float32Array.from(
    { length: 256 },
    (_, byte) => new Color().setRGB(byte / 255, 0, 0, SRGBColorSpace).r,
  );
  return Float32Array.from(bytes, (byte) => levels[byte]);
}
