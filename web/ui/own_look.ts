import type { Appearance } from "../engine/index.ts";
import { Texture, type Graphics } from "../render/index.ts";

const AS_IT_IS = { premultiplyAlpha: "none", colorSpaceConversion: "none" } as const;

/** The user's own materials with their textures, which all surfaces of a body share. */
export class OwnLook {
  readonly appearance: Appearance;
  /** One per picture; white until it is decoded. */
  readonly textures: readonly Texture[];
  /** Resolves when all pictures are decoded. A picture that cannot be is left white. */
  readonly ready: Promise<unknown>;

  #isDisposed = false;

  /** Null for a body without materials of its own. */
  static of(appearance: Appearance | null, { mostTexels }: Graphics): OwnLook | null {
    return appearance && new OwnLook(appearance, mostTexels);
  }

  /** `mostTexels` is the longest side of a texture; larger pictures are scaled down. */
  private constructor(appearance: Appearance, mostTexels: number) {
    this.appearance = appearance;
    this.textures = appearance.textures.map(white);
    const decode = async (bytes: Uint8Array<ArrayBuffer>, k: number) => {
      const picture = await decoded(bytes, mostTexels);
      if (this.#isDisposed) picture?.close();
      else if (picture) this.textures[k].picture = picture;
    };
    this.ready = Promise.all(appearance.textures.map(decode));
  }

  dispose(): void {
    this.#isDisposed = true;
    for (const texture of this.textures) {
      texture.dispose();
      if (texture.data instanceof ImageBitmap) texture.data.close();
    }
  }
}

function white(): Texture {
  const data = new Uint8Array(4).fill(255);
  return new Texture({ format: "srgb", width: 1, height: 1, data, isPicture: true });
}

/** A picture, or null if it cannot be decoded. */
async function decoded(bytes: Uint8Array<ArrayBuffer>, mostTexels: number): Promise<ImageBitmap | null> {
  try {
    const picture = await createImageBitmap(new Blob([bytes]), AS_IT_IS);
    const longest = Math.max(picture.width, picture.height);
    if (longest <= mostTexels) return picture;
    const [resizeWidth, resizeHeight] = [picture.width, picture.height].map((side) =>
      Math.max(Math.floor((side * mostTexels) / longest), 1),
    );
    const size = { resizeWidth, resizeHeight, resizeQuality: "high" } as const;
    const smaller = await createImageBitmap(picture, { ...AS_IT_IS, ...size });
    picture.close();
    return smaller;
  } catch (error) {
    if (!(error instanceof DOMException)) throw error;
    return null;
  }
}
