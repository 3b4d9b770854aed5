import { type Camera, Color, Vector3 } from "three";

import type { Uniform } from "./program.ts";

/** The middle of a panel of light, the cosine of its radius, and its radiance. */
type Panel = readonly [middle: Vector3, edge: number, color: readonly [number, number, number]];

/** A warm window to the left, a cool one behind to the right, and the ceiling. */
const PANELS: readonly Panel[] = [
  [new Vector3(-0.75, 0.5, 0.45).normalize(), 0.8, [2.3, 2.1, 1.85]],
  [new Vector3(0.85, 0.25, -0.45).normalize(), 0.85, [1.1, 1.35, 1.8]],
  [new Vector3(0, 1, 0), 0.6, [1.5, 1.5, 1.55]],
];
const [SKY, FLOOR] = [
  [0.55, 0.58, 0.64],
  [0.42, 0.37, 0.31],
] as const;
const SAMPLES = 2000;
const STRENGTH = 1.15;

/** A key light, which has a shadow, and a rim light: where they are if the camera is in front, and their radiance. */
const [KEY, RIM] = [new Vector3(1.4, 2.6, 1.2), new Vector3(-0.8, 1.4, -2)];
export const KEY_DISTANCE = KEY.length();
const COLORS = [new Color("#fff1e0").multiplyScalar(2.5), new Color("#ffffff").multiplyScalar(1.1)];
const UP = new Vector3(0, 1, 0);

/** The light of a studio: from all sides as in a picture that is computed here, so that no file is loaded, and two lights
 * that turn with the camera, so that they light what is seen. */
export class Studio {
  readonly uniforms: Readonly<Record<"lightDirections" | "lightColors" | "irradiance", Uniform>>;
  /** The direction to the key light. */
  readonly key = new Vector3();
  readonly #front: Vector3;
  readonly #middle: Vector3;
  readonly #directions = new Float32Array(6);

  /** `front` is the camera's direction from the middle for which the lights are where they were put; `middle` may move. */
  constructor(front: Vector3, middle: Vector3) {
    [this.#front, this.#middle] = [front, middle];
    this.uniforms = {
      lightDirections: { value: this.#directions },
      lightColors: { value: COLORS.flatMap(({ r, g, b }) => [r, g, b]) },
      irradiance: { value: irradianceOf(radiance) },
    };
  }

  /** Turns the lights with a camera that goes around the middle. */
  follow({ position: { x, z } }: Camera): void {
    const angle =
      Math.atan2(x - this.#middle.x, z - this.#middle.z) - Math.atan2(this.#front.x, this.#front.z);
    this.key.copy(KEY).applyAxisAngle(UP, angle).normalize().toArray(this.#directions);
    RIM.clone().applyAxisAngle(UP, angle).normalize().toArray(this.#directions, 3);
  }
}

/** What a matt surface sees of the light from all sides, for each direction of its normal: nine colours, the factors of
 * the spherical harmonics of degree two in `lighting.ts` (Ramamoorthi and Hanrahan 2001, equations 10 to 12). */
export function irradianceOf(radiance: (direction: Vector3) => readonly number[]): Float32Array {
  const sum = new Float32Array(27);
  for (let k = 0; k < SAMPLES; k++) {
    const direction = pointOfSphere(k);
    const light = radiance(direction);
    harmonics(direction).forEach((value, i) =>
      light.forEach((part, c) => (sum[3 * i + c] += (part * value * 4 * Math.PI) / SAMPLES)),
    );
  }
  return sum;
}

/** Polynomials of spherical harmonics, times the squares of their norms and the factors of the cosine's lobe. */
function harmonics({ x, y, z }: Vector3): number[] {
  const [zero, one, two] = [1 / 4, 1 / 2, 5 / 64];
  return [
    zero,
    one * y,
    one * z,
    one * x,
    12 * two * x * y,
    12 * two * y * z,
    two * (3 * z * z - 1),
    12 * two * x * z,
    3 * two * (x * x - y * y),
  ];
}

function radiance(direction: Vector3): readonly number[] {
  const up = 0.5 + 0.5 * direction.y;
  const light = SKY.map((sky, c) => up * sky + (1 - up) * FLOOR[c]);
  for (const [middle, edge, color] of PANELS)
    if (direction.dot(middle) > edge) color.forEach((value, c) => (light[c] += value));
  return light.map((value) => STRENGTH * value);
}

/** Evenly spread points: a Fibonacci lattice. */
function pointOfSphere(k: number): Vector3 {
  const y = 1 - (2 * k + 1) / SAMPLES;
  const angle = k * Math.PI * (3 - Math.sqrt(5));
  const radius = Math.sqrt(1 - y * y);
  return new Vector3(radius * Math.cos(angle), y, radius * Math.sin(angle));
}
