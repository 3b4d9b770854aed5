import {
  BufferAttribute,
  BufferGeometry,
  Camera,
  DataTexture,
  FloatType,
  GLSL3,
  Group,
  IntType,
  Mesh,
  NearestFilter,
  RawShaderMaterial,
  RGBAFormat,
  RGIntegerFormat,
  WebGLRenderTarget,
  type WebGLRenderer,
} from "three";

/** A computation on the graphics processor: a shader that fills a texture, one texel per item. */
export type Pass = Mesh<BufferGeometry, RawShaderMaterial>;

const VERTEX = `
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }`;

const CAMERA = new Camera();
CAMERA.matrixWorldAutoUpdate = false;

/** Pairs of integers, a texel each. */
export function integers(values: Int32Array, width: number, height: number): DataTexture {
  const texels = new Int32Array(2 * width * height);
  texels.set(values);
  const texture = new DataTexture(texels, width, height, RGIntegerFormat, IntType);
  texture.internalFormat = "RG32I";
  return texture;
}

export function pass(fragmentShader: string, uniforms: RawShaderMaterial["uniforms"]): Pass {
  const triangle = new BufferGeometry();
  triangle.setAttribute(
    "position",
    new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3),
  );
  const material = new RawShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader,
    uniforms,
    glslVersion: GLSL3,
    depthTest: false,
    depthWrite: false,
  });
  const mesh = new Mesh(triangle, material);
  mesh.frustumCulled = false;
  return mesh;
}

/** What a pass fills: four floats per texel. */
export function floatTarget(width: number, height: number): WebGLRenderTarget {
  return new WebGLRenderTarget(width, height, {
    type: FloatType,
    format: RGBAFormat,
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    depthBuffer: false,
  });
}

/** Passes that run one after the other, each into its target. */
export class Passes {
  readonly #renderer: WebGLRenderer;
  readonly #group = new Group();
  readonly #first: WebGLRenderTarget;

  constructor(renderer: WebGLRenderer, passes: readonly (readonly [Pass, WebGLRenderTarget])[]) {
    this.#renderer = renderer;
    this.#first = passes[0][1];
    passes.forEach(([mesh, target], order) => {
      mesh.renderOrder = order;
      if (order > 0) mesh.onBeforeRender = () => renderer.setRenderTarget(target);
      mesh.matrixAutoUpdate = false;
      this.#group.add(mesh);
    });
    this.#group.matrixWorldAutoUpdate = false;
  }

  /** As one call of the renderer, whose own work is more than that of the passes; it is left as it was. */
  run(): void {
    const renderer = this.#renderer;
    const { autoClear } = renderer;
    const shadows = renderer.shadowMap.autoUpdate;
    renderer.autoClear = false;
    renderer.shadowMap.autoUpdate = false;
    renderer.setRenderTarget(this.#first);
    renderer.render(this.#group, CAMERA);
    renderer.setRenderTarget(null);
    renderer.autoClear = autoClear;
    renderer.shadowMap.autoUpdate = shadows;
  }
}

export function disposePass({ geometry, material }: Pass): void {
  geometry.dispose();
  material.dispose();
}
