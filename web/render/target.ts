import { LostGraphics, type Graphics } from "./graphics.ts";
import { Texture, type TextureOptions } from "./texture.ts";

/** A texture that is drawn into. */
export class Target {
  readonly texture: Texture;
  readonly #graphics: Graphics;
  #buffer: WebGLFramebuffer | null = null;
  #generation = -1;

  constructor(graphics: Graphics, options: TextureOptions) {
    this.#graphics = graphics;
    this.texture = new Texture(options);
  }

  /** What is drawn from now on fills the texture. */
  bind(): void {
    const { gl, generation } = this.#graphics;
    const { width, height, format } = this.texture;
    if (this.#generation !== generation) {
      this.#generation = generation;
      this.#buffer = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.#buffer);
      const place = format === "depth" ? gl.DEPTH_ATTACHMENT : gl.COLOR_ATTACHMENT0;
      gl.framebufferTexture2D(gl.FRAMEBUFFER, place, gl.TEXTURE_2D, this.texture.handle(this.#graphics), 0);
      if (format === "depth") gl.drawBuffers([gl.NONE]);
    } else gl.bindFramebuffer(gl.FRAMEBUFFER, this.#buffer);
    gl.viewport(0, 0, width, height);
  }

  /** The texels of a target of floats, four numbers each. Throws `LostGraphics` while the context is lost. */
  read(): Float32Array<ArrayBuffer> {
    const { gl } = this.#graphics;
    const { width, height } = this.texture;
    if (this.#graphics.isLost) throw new LostGraphics();
    const texels = new Float32Array(4 * width * height);
    this.bind();
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, texels);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return texels;
  }

  dispose(): void {
    if (this.#generation === this.#graphics.generation) this.#graphics.gl.deleteFramebuffer(this.#buffer);
    this.#generation = -1;
    this.texture.dispose();
  }
}
