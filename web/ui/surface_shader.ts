import type { IUniform, Material, Texture } from "three";

export type SurfaceUniforms = Record<string, IUniform> & {
  shownPositions: IUniform<Texture>;
  shownNormals: IUniform<Texture>;
  shownStrains: IUniform<Texture>;
  shownWidth: IUniform<number>;
  /** 0: the vertices' own; 1: displacement; 2: strain. */
  shownColors: IUniform<number>;
  /** What the ramps end at: a length, and a strain. */
  displacementEnd: IUniform<number>;
  strainEnd: IUniform<number>;
};

const DECLARATIONS = `
uniform highp sampler2D shownPositions;
uniform highp sampler2D shownNormals;
uniform highp int shownWidth;
uniform highp sampler2D shownStrains;
uniform int shownColors;
uniform float displacementEnd;
uniform float strainEnd;
// from pale sand by coral to plum: lightness falls all the way, so it reads without colours as well
vec3 shownRamp(float x) {
  float t = clamp(x, 0.0, 1.0);
  vec3 a = vec3(0.80, 0.76, 0.66), b = vec3(0.86, 0.47, 0.22), c = vec3(0.55, 0.09, 0.20), d = vec3(0.10, 0.02, 0.16);
  return t < 0.33 ? mix(a, b, t / 0.33) : t < 0.7 ? mix(b, c, (t - 0.33) / 0.37) : mix(c, d, (t - 0.7) / 0.3);
}
`;
const CELL = "ivec2 shownCell = ivec2(gl_VertexID % shownWidth, gl_VertexID / shownWidth);";
const NORMAL = `
vec3 shownNormal = texelFetch(shownNormals, ivec2(gl_VertexID % shownWidth, gl_VertexID / shownWidth), 0).xyz;
vec3 objectNormal = shownNormal / max(length(shownNormal), 1e-30);`;
const POSITION = `
${CELL}
vec3 transformed = texelFetch(shownPositions, shownCell, 0).xyz;
#if defined( USE_COLOR )
  if (shownColors == 1) vColor.rgb = shownRamp(length(transformed - position) / displacementEnd);
  if (shownColors == 2) vColor.rgb = shownRamp(texelFetch(shownStrains, shownCell, 0).x / strainEnd);
#endif`;

/** Makes a material of three.js take positions and normals from textures in place of attributes. */
export function deformedBy(material: Material, uniforms: SurfaceUniforms): void {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader =
      DECLARATIONS +
      shader.vertexShader
        .replace("#include <beginnormal_vertex>", NORMAL)
        .replace("#include <begin_vertex>", POSITION);
  };
  material.customProgramCacheKey = () => "deformed";
}
