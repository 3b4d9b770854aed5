import { Color } from "three";

import { FLAT, material, NEARER, type Material, type Texture } from "../render/index.ts";
import { surfaceFragment, surfaceVertex, type Part, type SurfaceUniforms } from "./surface_shader.ts";

const CLAY_ROUGHNESS = 0.58;
const EDGE = new Color("#10141c");
const EDGE_OPACITY = 0.3;

/** What differs between materials in the studio's light. */
export interface Looks {
  readonly color: Color;
  readonly roughness: number;
  /** Texels with a smaller alpha are left out. */
  readonly alphaCutoff: number;
  readonly picture: Texture | null;
  /** For creased points: pairs of vertices, of the faces around each. */
  readonly pairs: Texture | null;
}

/** Clay in the colours of the vertices; `pairs` if it has sharp edges. */
export function clay(uniforms: SurfaceUniforms, pairs: Texture | null): Material {
  const color = new Color("#ffffff");
  const looks = { color, roughness: CLAY_ROUGHNESS, alphaCutoff: 0, picture: null, pairs };
  const parts: Part[] = pairs ? ["POINTS", "CREASED"] : [];
  return litSurface(uniforms, looks, [...parts, "COLORS", "RAMPS"]);
}

/** A material in the studio's light; `parts` are those of its vertices. */
export function litSurface(uniforms: SurfaceUniforms, looks: Looks, parts: readonly Part[]): Material {
  const { color, picture, pairs, roughness, alphaCutoff } = looks;
  const own = {
    color: { value: color.toArray() },
    roughness: { value: roughness },
    alphaCutoff: { value: alphaCutoff },
    ...(picture && { picture: { value: picture } }),
    ...(pairs && { ownPairs: { value: pairs } }),
  };
  const fragment = surfaceFragment(...parts.filter((part) => part === "PICTURE"));
  return material({ vertex: surfaceVertex(...parts), fragment, uniforms: { ...uniforms, ...own } });
}

/** The edges of faces, in front of them. */
export function wires(uniforms: SurfaceUniforms): Material {
  const own = {
    color: { value: EDGE.toArray() },
    opacity: { value: EDGE_OPACITY },
    nearer: { value: NEARER },
  };
  return material(
    { vertex: surfaceVertex("MOVED"), fragment: FLAT, uniforms: { ...uniforms, ...own } },
    { isTransparent: true, drawsLines: true },
  );
}
