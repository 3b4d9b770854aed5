import { RepeatWrapping, SRGBColorSpace, Texture } from "three";

import type { Appearance } from "../engine/index.ts";

const MOST_ANISOTROPY = 8;

/** The user's own materials with their textures, which all surfaces of a body share. */
export class OwnLook {
  readonly appearance: Appearance;
  /** One per picture; empty until it is decoded. */
  readonly textures: readonly Texture[];
  /** Resolves when all pictures are decoded. A picture that cannot be is left white. */
  readonly ready: Promise<unknown>;

  constructor(appearance: Appearance) {
    this.appearance = appearance;
    this.textures = appearance.textures.map(() => emptyTexture());
    this.ready = Promise.all(appearance.textures.map((bytes, k) => decode(bytes, this.textures[k])));
  }

  dispose(): void {
    for (const texture of this.textures) {
      texture.dispose();
      if (texture.image instanceof ImageBitmap) texture.image.close();
    }
  }
}

function emptyTexture(): Texture {
  const texture = new Texture();
  texture.colorSpace = SRGBColorSpace;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.flipY = false; // coordinates count from the upper left corner
  texture.anisotropy = MOST_ANISOTROPY;
  return texture;
}

async function decode(bytes: Uint8Array<ArrayBuffer>, texture: Texture): Promise<void> {
  try {
    texture.image = await createImageBitmap(new Blob([bytes]), {
      premultiplyAlpha: "none",
      colorSpaceConversion: "none",
    });
    texture.needsUpdate = true;
  } catch (error) {
    if (!(error instanceof DOMException)) throw error;
  }
}
