import assert from "node:assert/strict";
import { test } from "node:test";

import { PerspectiveCamera, Vector3 } from "three";

import { irradianceOf, Studio } from "../studio.ts";

/** The shader's polynomials, see `LIGHTING`. */
function irradianceAt(factors: Float32Array, { x, y, z }: Vector3): number {
  const values = [1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y];
  return values.reduce((sum, value, i) => sum + factors[3 * i] * value, 0);
}

const NORMALS = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, -1],
  [0.3, -0.8, 0.5],
  [-0.7, 0.2, 0.6],
].map(([x, y, z]) => new Vector3(x, y, z).normalize());

test("irradiance is the integral of the radiance times the cosine, exactly up to degree two", () => {
  const radiances: [(d: Vector3) => number, (n: Vector3) => number][] = [
    [() => 1, () => Math.PI],
    [(d) => 1 + d.y, (n) => Math.PI + (2 / 3) * Math.PI * n.y],
    [(d) => d.x * d.x, (n) => Math.PI / 3 + (Math.PI / 4) * (n.x * n.x - 1 / 3)],
    [(d) => 1 + d.x * d.z, (n) => Math.PI + (Math.PI / 4) * n.x * n.z],
  ];
  for (const [radiance, expected] of radiances) {
    const factors = irradianceOf((direction) => [radiance(direction), 0, 0]);
    for (const n of NORMALS) assert.ok(Math.abs(irradianceAt(factors, n) - expected(n)) < 5e-3);
  }
});

test("light from above lights what faces up most", () => {
  const factors = irradianceOf(({ y }) => [y > 0.9 ? 1 : 0, 0, 0]);
  const up = irradianceAt(factors, new Vector3(0, 1, 0));
  for (const n of NORMALS) assert.ok(irradianceAt(factors, n) <= up + 1e-6);
});

test("the key light turns with the camera about the middle, and is as high as before", () => {
  const [front, middle] = [new Vector3(0.6, 0.3, 0.8), new Vector3(0.1, 0, -0.2)];
  const studio = new Studio(front, middle);
  const camera = new PerspectiveCamera();
  const keyFrom = (angle: number) => {
    camera.position
      .copy(front)
      .applyAxisAngle(new Vector3(0, 1, 0), angle)
      .add(middle);
    studio.follow(camera);
    return studio.key.clone();
  };
  const first = keyFrom(0);
  for (const angle of [0.4, 2, -3]) {
    const expected = first.clone().applyAxisAngle(new Vector3(0, 1, 0), angle);
    assert.ok(keyFrom(angle).distanceTo(expected) < 1e-9);
  }
});
