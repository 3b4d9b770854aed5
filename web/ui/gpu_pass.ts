import { Target, Texture, type Graphics, type Uniform } from "../render/index.ts";

/** A triangle that covers the target, without attributes: then it does not matter which arrays are bound. */
const VERTEX = `
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`;

/** Pairs of integers, a texel each. */
export function integers(values: Int32Array, width: number, height: number): Texture {
  const data = new Int32Array(2 * width * height);
  data.set(values);
  return new Texture({ format: "rg32i", width, height, data });
}

/** What a pass fills: four floats per texel. */
export function floatTarget(graphics: Graphics, width: number, height: number): Target {
  return new Target(graphics, { format: "rgba32f", width, height });
}

/** A computation on the graphics processor: a shader that fills a texture, one texel per item. */
export class Pass {
  readonly target: Target;
  readonly #graphics: Graphics;
  readonly #fragment: string;
  readonly #uniforms: Readonly<Record<string, Uniform>>;

  constructor(
    graphics: Graphics,
    fragment: string,
    uniforms: Readonly<Record<string, Uniform>>,
    target: Target,
  ) {
    [this.#graphics, this.#fragment, this.#uniforms, this.target] = [graphics, fragment, uniforms, target];
  }

  /** Fills the target; `runPasses` sets what all passes need. */
  draw(): void {
    const { gl } = this.#graphics;
    const program = this.#graphics.program(VERTEX, this.#fragment);
    this.target.bind();
    program.use();
    program.set(this.#uniforms);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  dispose(): void {
    this.target.dispose();
  }
}

/** Passes one after the other; what is drawn then goes to the canvas again. */
export function runPasses(graphics: Graphics, passes: readonly Pass[]): void {
  const { gl } = graphics;
  if (graphics.isLost) return; // all is drawn again once it is back
  gl.disable(gl.DEPTH_TEST);
  gl.disable(gl.BLEND); // floats may not be blended
  for (const pass of passes) pass.draw();
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
}
