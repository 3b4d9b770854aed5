import { Program } from "./program.ts";
import type { Texture } from "./texture.ts";

/** Units of textures that every browser has. */
const UNITS = 16;

/** The browser has taken the context away; mostly it gives it back soon. */
export class LostGraphics extends RangeError {
  constructor() {
    super("The browser has no graphics for this page at the moment; try again.");
  }
}

/** The WebGL 2 context of a canvas, and the programs that were compiled in it.
 *
 * Browsers may take a context away and give it back empty. Textures, geometries and programs compare `generation`, and
 * make themselves again. */
export class Graphics {
  readonly canvas: HTMLCanvasElement;
  readonly gl: WebGL2RenderingContext;
  /** Whether it can draw into textures of floats. */
  readonly canDrawFloats: boolean;
  /** Texels along a side of the largest texture. */
  readonly mostTexels: number;
  #generation = 0;
  /** By vertex shader, then by fragment shader. */
  readonly #programs = new Map<string, Map<string, Program>>();
  /** Textures that are bound to units, and the number of the last use of each. Most stay there from picture to picture. */
  readonly #held = new Array<Texture | null>(UNITS).fill(null);
  readonly #uses = new Array<number>(UNITS).fill(0);
  #count = 0;
  #used: WebGLProgram | null = null;

  /** Throws an Error in browsers without WebGL 2. */
  constructor(canvas: HTMLCanvasElement) {
    const gl = canvas.getContext("webgl2", {
      alpha: true,
      antialias: true,
      powerPreference: "high-performance",
    });
    if (!gl) throw new Error("This browser has no WebGL 2.");
    [this.canvas, this.gl] = [canvas, gl];
    this.canDrawFloats = prepared(gl);
    this.mostTexels = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    // the default is never to give a lost context back
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => {
      this.#generation++;
      this.#programs.clear();
      this.#held.fill(null);
      this.#used = null;
      prepared(gl);
    });
  }

  /** How often the context was given back. What was made before is gone. */
  get generation(): number {
    return this.#generation;
  }

  get isLost(): boolean {
    return this.gl.isContextLost();
  }

  /** The program of two shaders, which is compiled once. */
  program(vertex: string, fragment: string): Program {
    let of = this.#programs.get(vertex);
    if (!of) this.#programs.set(vertex, (of = new Map()));
    let program = of.get(fragment);
    if (!program) of.set(fragment, (program = new Program(this, vertex, fragment)));
    return program;
  }

  /** Selects the program for what is drawn next. */
  use(program: WebGLProgram): void {
    if (this.#used !== program) this.gl.useProgram(program);
    this.#used = program;
  }

  /** The unit to which a texture is bound: its own, or the least recently used one. */
  unitOf(texture: Texture, target: GLenum, handle: WebGLTexture): number {
    let unit = this.#held.indexOf(texture);
    if (unit < 0) {
      unit = this.#uses.indexOf(Math.min(...this.#uses));
      this.#held[unit] = texture;
      this.gl.activeTexture(this.gl.TEXTURE0 + unit);
      this.gl.bindTexture(target, handle);
    }
    this.#uses[unit] = ++this.#count;
    return unit;
  }

  /** Forgets a texture that was deleted. */
  forget(texture: Texture): void {
    const unit = this.#held.indexOf(texture);
    if (unit >= 0) this.#held[unit] = null;
  }

  /** Gives the context back to the browser: it has few for a page. The canvas cannot be drawn on again. */
  dispose(): void {
    this.#programs.clear();
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }
}

/** Sets what a new context needs, and says whether it can draw into textures of floats. */
function prepared(gl: WebGL2RenderingContext): boolean {
  gl.depthFunc(gl.LEQUAL);
  return gl.getExtension("EXT_color_buffer_float") !== null;
}
