import type { Container } from "./container.ts";

/** A material of the user's own file. */
export interface OwnMaterial {
  /** Red, green and blue in [0, 1], linear; the texture is multiplied by it. */
  readonly color: readonly [number, number, number];
  readonly texture: number | null;
  readonly roughness: number;
  /** Texels with a smaller alpha are not drawn. */
  readonly alphaCutoff: number | null;
  /** Number of its triangles, which follow those of the materials before. */
  readonly triangles: number;
}

/** How the user's own file wants a surface to look (snapspace/model_file/appearance.py). */
export interface Appearance {
  /** The surface's vertex of each point that is drawn. */
  readonly points: Int32Array<ArrayBuffer>;
  readonly triangles: Uint32Array<ArrayBuffer>;
  /** Points of a vertex with the same number share a normal; null without sharp edges. */
  readonly creases: Int32Array<ArrayBuffer> | null;
  /** Two per point, from the upper left corner of the texture. */
  readonly coordinates: Float32Array<ArrayBuffer> | null;
  /** Three bytes per point, sRGB. */
  readonly colors: Uint8Array<ArrayBuffer> | null;
  readonly materials: readonly OwnMaterial[];
  /** Picture files. */
  readonly textures: readonly Uint8Array<ArrayBuffer>[];
}

interface Stored {
  materials: {
    color: [number, number, number];
    texture: number | null;
    roughness: number;
    alpha_cutoff: number | null;
    triangles: number;
  }[];
  /** In model files, where each texture starts among the files beside the surface, and its size; null: it is stored
   * separately. */
  textures?: ([start: number, size: number] | null)[];
}

export function readAppearance(container: Container, about: unknown, vertices: number): Appearance | null {
  if (!about) return null; // also in files from before appearances
  const [count] = container.shape("own_points", 1);
  const [triangles] = container.shape("own_triangles", 2);
  const stored = about as Stored;
  return {
    points: container.indices("own_points", vertices, [count]),
    triangles: Uint32Array.from(container.indices("own_triangles", count, [triangles, 3])),
    creases: container.has("own_creases") ? container.indices("own_creases", triangles * 3, [count]) : null,
    coordinates: container.has("own_coordinates") ? container.floats("own_coordinates", count, 2) : null,
    colors: container.has("own_colors") ? container.bytes("own_colors", count, 3) : null,
    materials: stored.materials.map(({ alpha_cutoff: alphaCutoff, ...material }) => ({
      ...material,
      alphaCutoff,
    })),
    textures: texturesOf(container, stored),
  };
}

function texturesOf(container: Container, { textures: places = [] }: Stored): Uint8Array<ArrayBuffer>[] {
  const beside = places.some((place) => place) ? container.bytes("surface_beside") : new Uint8Array();
  const found: Uint8Array<ArrayBuffer>[] = [];
  for (let k = 0; places[k] || container.has(`own_texture_${k}`); k++) {
    const [start, size] = places[k] ?? [0, 0];
    found.push(places[k] ? beside.slice(start, start + size) : container.bytes(`own_texture_${k}`));
  }
  return found;
}
