import { LIGHTING, ON_SCREEN, SCREEN, type Texture, type Uniform } from "../render/index.ts";

/** What all materials of a surface read. */
export type SurfaceUniforms = {
  shownPositions: Uniform<Texture>;
  shownNormals: Uniform<Texture>;
  shownStrains: Uniform<Texture>;
  shownWidth: Uniform<number>;
  /** 0: the vertices' own; 1: displacement; 2: strain. */
  shownColors: Uniform<number>;
  /** What the ramps end at: a length, and a strain. */
  displacementEnd: Uniform<number>;
  strainEnd: Uniform<number>;
  /** The texture of `Occlusion`, where the surface is occluded. */
  shownOcclusion: Uniform<Texture>;
  isOccluded: Uniform<boolean>;
  /** Whether shadows fall on it. */
  isShadowed: Uniform<boolean>;
  /** Whether it hides its own backs, which would show as specks on silhouettes. */
  encloses: Uniform<boolean>;
  /** Less than one where it is faded. */
  opacity: Uniform<number>;
};

/** Parts of the shaders: COLORS has colours of vertices, and RAMPS those of displacements and strains. POINTS has points
 * with an attribute `ownVertex`; several points may have the same vertex of the surface. CREASED has their normals on
 * both sides of edges, from faces around a point: where these start among `ownPairs`, and how many there are; a point
 * without any has the normal of its vertex. PICTURE has a texture. MOVED is moved before what it lies on, or behind it. */
export type Part = "COLORS" | "RAMPS" | "POINTS" | "CREASED" | "PICTURE" | "MOVED";

/** The model's matrix is a motion and a scale, so that normals turn as places do. `ramp` goes from pale sand by coral to
 * plum: lightness falls all the way, so it reads without colours as well. */
const VERTEX = `
uniform mat4 model, view, projection;
uniform sampler2D shownPositions, shownNormals, shownStrains, shownOcclusion;
uniform int shownWidth, shownColors;
uniform float displacementEnd, strainEnd, nearer;
uniform bool isOccluded;
uniform vec3 color;
out vec3 place, normal, tint;
out vec2 corner;
out float open;
#ifdef COLORS
in vec3 vertexColor;
#endif
#ifdef RAMPS
in vec3 position;
#endif
#ifdef PICTURE
in vec2 uv;
#endif
#ifdef POINTS
in int ownVertex;
#else
#define ownVertex gl_VertexID
#endif
#ifdef CREASED
in ivec2 ownRing;
uniform isampler2D ownPairs;
#endif
${ON_SCREEN}
ivec2 cellOf(int vertex) { return ivec2(vertex % shownWidth, vertex / shownWidth); }
vec3 placeOf(int vertex) { return texelFetch(shownPositions, cellOf(vertex), 0).xyz; }
vec3 ramp(float x) {
  float t = clamp(x, 0.0, 1.0);
  vec3 a = vec3(0.80, 0.76, 0.66), b = vec3(0.86, 0.47, 0.22), c = vec3(0.55, 0.09, 0.20), d = vec3(0.10, 0.02, 0.16);
  return t < 0.33 ? mix(a, b, t / 0.33) : t < 0.7 ? mix(b, c, (t - 0.33) / 0.37) : mix(c, d, (t - 0.7) / 0.3);
}
vec3 normalOf(vec3 own) {
  vec3 sum = texelFetch(shownNormals, cellOf(ownVertex), 0).xyz;
#ifdef CREASED
  if (ownRing.y > 0) sum = vec3(0.0);
  int width = textureSize(ownPairs, 0).x;
  for (int i = ownRing.x; i < ownRing.x + ownRing.y; i++) {
    ivec2 pair = texelFetch(ownPairs, ivec2(i % width, i / width), 0).xy;
    sum += cross(placeOf(pair.x) - own, placeOf(pair.y) - own);
  }
#endif
  return sum;
}
void main() {
  ivec2 cell = cellOf(ownVertex);
  vec3 own = placeOf(ownVertex), sum = normalOf(own);
  place = (model * vec4(own, 1.0)).xyz;
  normal = mat3(model) * (sum / max(length(sum), 1e-30));
  open = isOccluded ? texelFetch(shownOcclusion, cell, 0).x : 1.0;
  tint = color;
#ifdef COLORS
  tint *= vertexColor;
#endif
#ifdef RAMPS
  if (shownColors == 1) tint = ramp(length(own - position) / displacementEnd);
  if (shownColors == 2) tint = ramp(texelFetch(shownStrains, cell, 0).x / strainEnd);
#endif
#ifdef PICTURE
  corner = uv;
#endif
#ifdef MOVED
  gl_Position = projected(view, projection, place, nearer);
#else
  gl_Position = projection * view * vec4(place, 1.0);
#endif
}`;

const FRAGMENT = `
${LIGHTING}
${SCREEN}
uniform float roughness, opacity, alphaCutoff;
uniform bool isShadowed, encloses;
#ifdef PICTURE
uniform sampler2D picture;
#endif
in vec3 place, normal, tint;
in vec2 corner;
in float open;
out vec4 shown;
void main() {
  vec4 matt = vec4(tint, 1.0);
#ifdef PICTURE
  matt *= texture(picture, corner);
#endif
  if (matt.a < alphaCutoff || encloses && alphaCutoff == 0.0 && !gl_FrontFacing) discard;
  vec3 n = normalize(normal) * (gl_FrontFacing ? 1.0 : -1.0);
  shown = vec4(onScreen(toned(lit(matt.rgb, roughness, n, place, isShadowed, open))), opacity);
}`;

/** Takes positions and normals from textures, in which a vertex is a texel. */
export function surfaceVertex(...parts: Part[]): string {
  return defined(parts) + VERTEX;
}

/** A surface in the light of the studio. */
export function surfaceFragment(...parts: Part[]): string {
  return defined(parts) + FRAGMENT;
}

function defined(parts: readonly Part[]): string {
  return parts.map((part) => `#define ${part}\n`).join("");
}
