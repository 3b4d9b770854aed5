import { MeshStandardMaterial, type IUniform, type Material, type Texture } from "three";

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
  /** Of `Occlusion`, where the surface is occluded. */
  shownOcclusion: IUniform<Texture>;
  isOccluded: IUniform<boolean>;
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
const CELL = `
ivec2 shownCellOf(int vertex) { return ivec2(vertex % shownWidth, vertex / shownWidth); }
vec3 shownPlace(int vertex) { return texelFetch(shownPositions, shownCellOf(vertex), 0).xyz; }
`;
/** Vertices of the surface are those that are drawn. */
const SAME = `
#define SHOWN_VERTEX gl_VertexID
`;
/** Several points that are drawn are the same vertex of the surface. */
const POINTS = `
attribute int ownVertex;
#define SHOWN_VERTEX ownVertex
`;
/** The faces around a point on its side of an edge: where they start among the pairs, and how many there are. */
const RING = `
attribute ivec2 ownRing;
uniform highp isampler2D ownPairs;
`;
const NORMAL = `
vec3 shownNormal = texelFetch(shownNormals, shownCellOf(SHOWN_VERTEX), 0).xyz;
vec3 objectNormal = shownNormal / max(length(shownNormal), 1e-30);`;
const CREASED_NORMAL = `
vec3 shownNormal = vec3(0.0), shownOwn = shownPlace(SHOWN_VERTEX);
int shownPairsWidth = textureSize(ownPairs, 0).x;
for (int i = ownRing.x; i < ownRing.x + ownRing.y; i++) {
  ivec2 pair = texelFetch(ownPairs, ivec2(i % shownPairsWidth, i / shownPairsWidth), 0).xy;
  shownNormal += cross(shownPlace(pair.x) - shownOwn, shownPlace(pair.y) - shownOwn);
}
vec3 objectNormal = shownNormal / max(length(shownNormal), 1e-30);`;
const POSITION = "vec3 transformed = shownPlace(SHOWN_VERTEX);";
const COLOR = `
#if defined( USE_COLOR )
  if (shownColors == 1) vColor.rgb = shownRamp(length(transformed - position) / displacementEnd);
  if (shownColors == 2) vColor.rgb = shownRamp(texelFetch(shownStrains, shownCellOf(SHOWN_VERTEX), 0).x / strainEnd);
#endif`;

/** The share of light from all sides that reaches the surface. */
const LIGHT = `
varying float shownLight;
`;
const OCCLUSION = `
uniform mediump sampler2D shownOcclusion;
uniform bool isOccluded;
`;
const REACHING = `
shownLight = isOccluded ? texelFetch(shownOcclusion, shownCellOf(SHOWN_VERTEX), 0).x : 1.0;`;
/** The key lights stand for areas, which creases see less of as well. The square is a matter of taste. */
const SHADED = `
reflectedLight.indirectDiffuse *= shownLight * shownLight;
reflectedLight.directDiffuse *= shownLight;
reflectedLight.directSpecular *= shownLight;`;

/** Makes a material of three.js take positions and normals from textures in place of attributes. */
export function deformedBy(material: Material, uniforms: SurfaceUniforms): void {
  replaced(material, uniforms, "deformed", SAME, NORMAL, POSITION + COLOR);
}

/** The same for points with an attribute `ownVertex`; with pairs of faces also `ownRing`, and normals on both sides of
 * edges. */
export function deformedPoints(material: Material, uniforms: SurfaceUniforms, pairs: Texture | null): void {
  if (pairs) {
    const all = { ...uniforms, ownPairs: { value: pairs } };
    replaced(material, all, "creased points", POINTS + RING, CREASED_NORMAL, POSITION);
  } else replaced(material, uniforms, "points", POINTS, NORMAL, POSITION);
}

function replaced(
  material: Material,
  uniforms: Record<string, IUniform>,
  key: string,
  declarations: string,
  normal: string,
  position: string,
): void {
  const isLit = material instanceof MeshStandardMaterial;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader =
      DECLARATIONS +
      CELL +
      declarations +
      (isLit ? LIGHT + OCCLUSION : "") +
      shader.vertexShader
        .replace("#include <beginnormal_vertex>", normal)
        .replace("#include <begin_vertex>", position + (isLit ? REACHING : ""));
    if (isLit)
      shader.fragmentShader = LIGHT + shader.fragmentShader.replace("#include <aomap_fragment>", SHADED);
  };
  material.customProgramCacheKey = () => key;
}
