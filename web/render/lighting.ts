/** GLSL of fragments: light of the studio, and colours of the screen.
 *
 * `lit` is what a matt body with a coat of refractive index 1.5 reflects: Lambert's diffuse part, and the specular part of
 * Trowbridge and Reitz (GGX) with Smith's masking (Heitz 2014) and Schlick's Fresnel factor, as glTF 2.0 has them. There are
 * no glints where normals bend within a pixel. `open` is the share of light from all sides that creases leave. The key lights
 * stand for areas, which creases see less of as well; the square is a matter of taste.
 * `unshadowed` is the share of the key light that arrives: the mean of nine places, each of four texels.
 * `fromAllSides` is the light from the studio's panels, by spherical harmonics.
 * `coatOfEven` is what the coat reflects of even light (Karis 2014, on mobile), and COAT what it reflects at a right angle.
 *
 * The comments are here, because those in GLSL would be sent with every page. */
export const LIGHTING = `
uniform vec3 eye;
uniform vec3 lightDirections[2];
uniform vec3 lightColors[2];
uniform vec3 irradiance[9];
uniform sampler2DShadow shadowMap;
uniform mat4 shadowMatrix;
const float PI = 3.141592653589793;
const float COAT = 0.04;

float unshadowed(vec3 place, vec3 normal) {
  vec3 at = (shadowMatrix * vec4(place + 0.02 * normal, 1.0)).xyz;
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
  vec2 step = 1.4 / vec2(textureSize(shadowMap, 0));
  float sum = 0.0;
  for (int i = 0; i < 9; i++)
    sum += texture(shadowMap, vec3(at.xy + step * vec2(i % 3 - 1, i / 3 - 1), at.z - 0.0004));
  return sum / 9.0;
}

vec3 fromAllSides(vec3 n) {
  return irradiance[0] + irradiance[1] * n.y + irradiance[2] * n.z + irradiance[3] * n.x +
    irradiance[4] * n.x * n.y + irradiance[5] * n.y * n.z + irradiance[6] * (3.0 * n.z * n.z - 1.0) +
    irradiance[7] * n.x * n.z + irradiance[8] * (n.x * n.x - n.y * n.y);
}

float coatOfEven(float roughness, float facing) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * facing)) * r.x + r.y;
  vec2 scaled = vec2(-1.04, 1.04) * a + r.zw;
  return COAT * scaled.x + scaled.y;
}

vec3 lit(vec3 diffuse, float roughness, vec3 n, vec3 place, bool isShadowed, float open) {
  vec3 v = normalize(eye - place);
  vec3 bent = max(abs(dFdx(n)), abs(dFdy(n)));
  float rough = min(max(roughness, 0.05) + max(max(bent.x, bent.y), bent.z), 1.0);
  float a2 = pow(rough, 4.0), nv = clamp(dot(n, v), 0.0, 1.0);
  vec3 sum = open * open * diffuse / PI * fromAllSides(n) * (1.0 - coatOfEven(rough, nv));
  float shadow = isShadowed ? unshadowed(place, n) : 1.0;
  for (int i = 0; i < 2; i++) {
    vec3 l = lightDirections[i], h = normalize(l + v);
    float nl = clamp(dot(n, l), 0.0, 1.0), nh = clamp(dot(n, h), 0.0, 1.0), vh = clamp(dot(v, h), 0.0, 1.0);
    float spread = nh * nh * (a2 - 1.0) + 1.0;
    float masked = nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl);
    float fresnel = COAT + (1.0 - COAT) * pow(1.0 - vh, 5.0);
    float specular = fresnel * a2 / (PI * spread * spread) * 0.5 / max(masked, 1e-6);
    sum += open * nl * (i == 0 ? shadow : 1.0) * lightColors[i] * ((1.0 - fresnel) * diffuse / PI + specular);
  }
  return sum;
}
`;

/** From linear radiance to the screen's sRGB. `toned` rolls off what is too bright, as the Khronos PBR Neutral Tone Mapper. */
export const SCREEN = `
vec3 toned(vec3 color) {
  float least = min(color.r, min(color.g, color.b));
  color -= least < 0.08 ? least - 6.25 * least * least : 0.04;
  float peak = max(color.r, max(color.g, color.b)), start = 0.76, room = 1.0 - start;
  if (peak < start) return color;
  float lower = 1.0 - room * room / (peak + room - start);
  return mix(color * lower / peak, vec3(lower), 1.0 - 1.0 / (0.15 * (peak - lower) + 1.0));
}
vec3 onScreen(vec3 color) {
  return mix(12.92 * color, 1.055 * pow(max(color, 0.0), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, color));
}
`;
