import type { Appearance } from "../engine/index.ts";
import { Texture } from "../render/index.ts";

/** The user's own materials with their textures, which all surfaces of a body share. */
export class OwnLook {
  readonly appearance: Appearance;
  /** One per picture; white until it is decoded. */
  readonly textures: readonly Texture[];
  /** Resolves when all pictures are decoded. A picture that cannot be is left white. */
  readonly ready: Promise<unknown>;

  constructor(appearance: Appearance) {
    this.appearance = appearance;
    this.textures = appearance.textures.map(white);
    this.ready = Promise.all(appearance.textures.map((bytes, k) => decode(bytes, this.textures[k])));
  }

  dispose(): void {
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

async function decode(bytes: Uint8Array<ArrayBuffer>, texture: Texture): Promise<void> {
  try {
    texture.picture = await createImageBitmap(new Blob([bytes]), {
      premultiplyAlpha: "none",
      colorSpaceConversion: "none",
    });
  } catch (error) {
    if (!(error instanceof DOMException)) throw error;
  }
}
