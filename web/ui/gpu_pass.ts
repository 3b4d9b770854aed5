import {
  BufferAttribute,
  BufferGeometry,
  Camera,
  DataTexture,
  FloatType,
  GLSL3,
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

/** Runs passes one after the other, each into its target; the renderer is left as it was. */
export function run(renderer: WebGLRenderer, passes: readonly (readonly [Pass, WebGLRenderTarget])[]): void {
  const { autoClear } = renderer;
  const shadows = renderer.shadowMap.autoUpdate;
  renderer.autoClear = false;
  renderer.shadowMap.autoUpdate = false;
  for (const [mesh, target] of passes) {
    renderer.setRenderTarget(target);
    renderer.render(mesh, CAMERA);
  }
  renderer.setRenderTarget(null);
  renderer.autoClear = autoClear;
  renderer.shadowMap.autoUpdate = shadows;
}

export function disposePass({ geometry, material }: Pass): void {
  geometry.dispose();
  material.dispose();
}
