import { DirectionalLight, Group, LightProbe, Vector3 } from "three";

/** An area of the studio's picture that gives light: its middle, the cosine at its edge, colour and strength. */
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

/** Light from all sides as in a picture of a studio that is computed here: no file is loaded. Its spherical harmonics of
 * degree two are what a matt surface sees of it (Ramamoorthi and Hanrahan 2001). */
export function studioLight(): LightProbe {
  const probe = new LightProbe(undefined, STRENGTH);
  const basis = new Array<number>(9).fill(0);
  for (let k = 0; k < SAMPLES; k++) {
    const direction = pointOfSphere(k);
    const [r, g, b] = radiance(direction);
    shBasis(direction, basis);
    basis.forEach((value, i) => {
      const share = (value * 4 * Math.PI) / SAMPLES;
      probe.sh.coefficients[i].add(new Vector3(r, g, b).multiplyScalar(share));
    });
  }
  return probe;
}

/** A key light with a soft shadow, a fill and a rim. The group turns with the camera, so that they light what is seen. */
export function keyLights(): Group {
  const key = new DirectionalLight(0xfff1e0, 2.5);
  key.position.set(1.4, 2.6, 1.2);
  key.castShadow = true;
  key.shadow.mapSize.set(1024, 1024);
  key.shadow.radius = 2.5;
  key.shadow.bias = -0.0004;
  key.shadow.normalBias = 0.02;
  const box = key.shadow.camera;
  [box.left, box.right, box.bottom, box.top, box.near, box.far] = [-1.3, 1.3, -1.3, 1.3, 0.5, 6];
  const rim = new DirectionalLight(0xffffff, 1.1);
  rim.position.set(-0.8, 1.4, -2);
  return new Group().add(key, rim);
}

function radiance(direction: Vector3): [number, number, number] {
  const up = 0.5 + 0.5 * direction.y;
  const light = SKY.map((sky, c) => up * sky + (1 - up) * FLOOR[c]) as [number, number, number];
  for (const [middle, edge, color] of PANELS)
    if (direction.dot(middle) > edge) color.forEach((value, c) => (light[c] += value));
  return light;
}

/** Evenly spread points: a Fibonacci lattice. */
function pointOfSphere(k: number): Vector3 {
  const y = 1 - (2 * k + 1) / SAMPLES;
  const angle = k * Math.PI * (3 - Math.sqrt(5));
  const radius = Math.sqrt(1 - y * y);
  return new Vector3(radius * Math.cos(angle), y, radius * Math.sin(angle));
}

/** Real spherical harmonics up to degree two, in the order of three.js. */
function shBasis({ x, y, z }: Vector3, into: number[]): void {
  into[0] = 0.282095;
  into[1] = 0.488603 * y;
  into[2] = 0.488603 * z;
  into[3] = 0.488603 * x;
  into[4] = 1.092548 * x * y;
  into[5] = 1.092548 * y * z;
  into[6] = 0.315392 * (3 * z * z - 1);
  into[7] = 1.092548 * x * z;
  into[8] = 0.546274 * (x * x - y * y);
}
