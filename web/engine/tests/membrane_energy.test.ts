import assert from "node:assert/strict";
import { test } from "node:test";

import { EnergyScale, roundedUp } from "../energy_scale.ts";
import { planeStressRatio, triangleDensities, vertexDensities } from "../membrane_energy.ts";
import type { PosingModel } from "../model.ts";
import { readModel } from "../read_model.ts";
import { bytes, distance, expected } from "./expected.ts";

interface Stretch {
  material: { lam: number; mu: number };
  rest: number[];
  faces: number[];
  shape: number[];
  density: number;
}
interface Bent {
  material: { lam: number; mu: number };
  rest: number[];
  faces: number[];
  shape: number[];
  densities: number[];
}

const { stretch, bent } = expected<{ stretch: Stretch; bent: Bent }>("energy.json");
const membraneOf = ({ material, rest }: Stretch | Bent) => ({
  rests: [Float32Array.from(rest)],
  ratio: planeStressRatio(material),
});

test("a stretch with free sides has the density of the body", () => {
  const membrane = membraneOf(stretch);
  const faces = Uint32Array.from(stretch.faces);
  for (const densities of [triangleDensities, vertexDensities]) {
    const found = densities(membrane, [1], stretch.shape, faces);
    const wanted = stretch.density / stretch.material.mu;
    assert.ok(found.some((w) => w > 0));
    assert.ok(
      found.every((w) => w === 0 || Math.abs(w / wanted - 1) < 1e-4),
      "vertices inside have none",
    );
  }
});

test("on a bent body it follows the density of the tets below", () => {
  const found = triangleDensities(membraneOf(bent), [1], bent.shape, Uint32Array.from(bent.faces));
  const wanted = bent.densities.map((density) => density / bent.material.mu);
  const rho = correlation(ranks([...found]), ranks(wanted));
  assert.ok(rho > 0.8, `rank correlation ${rho}`);
  const sum = (values: ArrayLike<number>) => Array.from(values).reduce((total, value) => total + value, 0);
  const ratio = sum(found) / sum(wanted);
  assert.ok(ratio > 0.7 && ratio < 1.4, `${ratio}`);
});

test("rigid motions and the rest shape have none, and a mix of rests is the sum", () => {
  const membrane = membraneOf(bent);
  const faces = Uint32Array.from(bent.faces);
  const [c, s] = [Math.cos(0.7), Math.sin(0.7)];
  const turned = new Float64Array(bent.rest.length);
  for (let i = 0; i < turned.length; i += 3)
    turned.set(
      [
        c * bent.rest[i] - s * bent.rest[i + 1] + 3,
        s * bent.rest[i] + c * bent.rest[i + 1],
        bent.rest[i + 2] - 1,
      ],
      i,
    );
  assert.ok(triangleDensities(membrane, [1], turned, faces).every((w) => Math.abs(w) < 1e-10));
  const two = { rests: [...membrane.rests, Float32Array.from(bent.shape)], ratio: membrane.ratio };
  const alone = triangleDensities(two, [0, 1], bent.shape, faces);
  assert.ok(alone.every((w) => Math.abs(w) < 1e-10));
  const first = triangleDensities(membrane, [1], bent.shape, faces);
  assert.ok(distance(triangleDensities(two, [1, 0], bent.shape, faces), first) < 1e-12);
});

test("the scale covers nearly all, and rests while the shape changes little", () => {
  const model = readModel(bytes("posing.packed"), "") as PosingModel;
  const membrane = { rests: [model.space.base], ratio: planeStressRatio(model.material) };
  const scale = new EnergyScale(model.space, membrane, model.faces);
  const q = (size: number) => Float64Array.from({ length: model.dimension }, (_, i) => size / (1 + i));
  assert.equal(scale.look(q(0), [1]), false);
  assert.equal(scale.end, 1e-4);
  const size = 0.5 * model.coordinateScale;
  assert.equal(scale.look(q(size), [1]), true);
  const end = scale.end;
  for (const share of [0.99, 0.97, 1]) assert.equal(scale.look(q(share * size), [1]), false);
  scale.look(q(3 * size), [1]);
  assert.ok(scale.end > end);
  scale.look(q(0), [1]);
  assert.equal(scale.end, 1e-4);
  assert.deepEqual([0.0013, 0.002, 0.3, 7, 10].map(roundedUp), [0.002, 0.002, 0.5, 10, 10]);
});

function ranks(values: number[]): number[] {
  const order = values.map((_, i) => i).sort((a, b) => values[a] - values[b]);
  const rank = new Array<number>(values.length);
  order.forEach((index, place) => (rank[index] = place));
  return rank;
}

function correlation(a: number[], b: number[]): number {
  const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const centred = (values: number[]) => values.map((value) => value - mean(values));
  const dot = (x: number[], y: number[]) => x.reduce((sum, value, i) => sum + value * y[i], 0);
  const [x, y] = [centred(a), centred(b)];
  return dot(x, y) / Math.sqrt(dot(x, x) * dot(y, y));
}
