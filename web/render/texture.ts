import type { Graphics } from "./graphics.ts";

/** Kinds of texels: four floats, four 16-bit and two 32-bit whole numbers, a share of 255, colours in sRGB, and depths that
 * are compared. Each has an internal format, a format and a type of WebGL. */
const FORMATS = {
  rgba32f: ["RGBA32F", "RGBA", "FLOAT"],
  rgba16i: ["RGBA16I", "RGBA_INTEGER", "SHORT"],
  rg32i: ["RG32I", "RG_INTEGER", "INT"],
  r8: ["R8", "RED", "UNSIGNED_BYTE"],
  srgb: ["SRGB8_ALPHA8", "RGBA", "UNSIGNED_BYTE"],
  depth: ["DEPTH_COMPONENT24", "DEPTH_COMPONENT", "UNSIGNED_INT"],
} as const;
type Format = keyof typeof FORMATS;

type Pixels = ArrayBufferView | ImageBitmap;

export interface TextureOptions {
  readonly format: Format;
  readonly width: number;
  readonly height: number;
  /** Layers of an array of textures; 0: no array. */
  readonly layers?: number;
  /** Row by row; null: nothing yet. */
  readonly data?: Pixels | null;
  /** Continues periodically, and is filtered in all sizes. */
  readonly isPicture?: boolean;
}

const MOST_ANISOTROPY = 8;

/** A texture, which is on the graphics processor once it is bound. */
export class Texture {
  readonly format: Format;
  readonly layers: number;
  #width: number;
  #height: number;
  readonly #isPicture: boolean;
  #data: Pixels | null;
  #isChanged = true;
  #graphics: Graphics | null = null;
  #generation = -1;
  #handle: WebGLTexture | null = null;

  constructor({ format, width, height, layers = 0, data = null, isPicture = false }: TextureOptions) {
    [this.format, this.#width, this.#height, this.layers] = [format, width, height, layers];
    [this.#data, this.#isPicture] = [data, isPicture];
  }

  get width(): number {
    return this.#width;
  }

  get height(): number {
    return this.#height;
  }

  /** What is in it. After it was changed in place call `changed`. */
  get data(): Pixels | null {
    return this.#data;
  }

  /** Sends the data again before the next use. */
  changed(): void {
    this.#isChanged = true;
  }

  /** Sets a picture, with its size. */
  set picture(picture: ImageBitmap) {
    [this.#width, this.#height, this.#data] = [picture.width, picture.height, picture];
    this.changed();
  }

  /** Binds it, sends what has changed, and returns its unit. */
  bind(graphics: Graphics): number {
    const { gl } = graphics;
    if (this.#generation !== graphics.generation) {
      [this.#graphics, this.#generation] = [graphics, graphics.generation];
      this.#handle = gl.createTexture();
      this.#isChanged = true;
    }
    const unit = graphics.unitOf(this, this.#target(gl), this.#handle!);
    if (this.#isChanged) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      this.#send(gl);
    }
    return unit;
  }

  /** The handle, for targets. */
  handle(graphics: Graphics): WebGLTexture {
    this.bind(graphics);
    return this.#handle!;
  }

  dispose(): void {
    this.#graphics?.forget(this);
    if (this.#generation === this.#graphics?.generation) this.#graphics.gl.deleteTexture(this.#handle);
    this.#generation = -1;
  }

  #target(gl: WebGL2RenderingContext): GLenum {
    return this.layers > 0 ? gl.TEXTURE_2D_ARRAY : gl.TEXTURE_2D;
  }

  #send(gl: WebGL2RenderingContext): void {
    this.#isChanged = false;
    const target = this.#target(gl);
    const [internal, format, type] = FORMATS[this.format].map((name) => gl[name]);
    const { width, height, layers } = this;
    const data = this.#data as ArrayBufferView; // or a picture, which WebGL takes as well
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    if (layers > 0) gl.texImage3D(target, 0, internal, width, height, layers, 0, format, type, data);
    else gl.texImage2D(target, 0, internal, width, height, 0, format, type, data);
    const filter = this.#isPicture || this.format === "depth" ? gl.LINEAR : gl.NEAREST;
    gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, filter);
    gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, this.#isPicture ? gl.LINEAR_MIPMAP_LINEAR : filter);
    const wrap = this.#isPicture ? gl.REPEAT : gl.CLAMP_TO_EDGE;
    gl.texParameteri(target, gl.TEXTURE_WRAP_S, wrap);
    gl.texParameteri(target, gl.TEXTURE_WRAP_T, wrap);
    if (this.format === "depth") gl.texParameteri(target, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    if (this.#isPicture) refine(gl, target);
  }
}

/** Smaller sizes, and sharpness at flat angles. */
function refine(gl: WebGL2RenderingContext, target: GLenum): void {
  gl.generateMipmap(target);
  const sharp = gl.getExtension("EXT_texture_filter_anisotropic");
  if (!sharp) return;
  const most = gl.getParameter(sharp.MAX_TEXTURE_MAX_ANISOTROPY_EXT) as number;
  gl.texParameterf(target, sharp.TEXTURE_MAX_ANISOTROPY_EXT, Math.min(most, MOST_ANISOTROPY));
}
