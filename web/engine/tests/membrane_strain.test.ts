import assert from "node:assert/strict";
import { test } from "node:test";

import { triangleStrains, vertexStrains } from "../membrane_strain.ts";
import type { PosingModel } from "../model.ts";
import { readModel } from "../read_model.ts";
import { roundedUp, StrainScale } from "../strain_scale.ts";
import { bytes, distance, expected } from "./expected.ts";

interface Shape {
  rest: number[];
  faces: number[];
  shape: number[];
}
interface Stretch extends Shape {
  strain: number;
}
interface Bent extends Shape {
  strains: number[];
}

const { stretch, bent } = expected<{ stretch: Stretch; bent: Bent }>("strains.json");
const restsOf = ({ rest }: Shape) => [Float32Array.from(rest)];

test("the strain of a stretch is that along the sides", () => {
  const faces = Uint32Array.from(stretch.faces);
  for (const strains of [triangleStrains, vertexStrains]) {
    const found = strains(restsOf(stretch), [1], stretch.shape, faces);
    assert.ok(found.some((e) => e > 0));
    assert.ok(
      found.every((e) => e === 0 || Math.abs(e / stretch.strain - 1) < 1e-4),
      "vertices inside have none",
    );
  }
});

test("the strain of a bent body is that of the tets below, along the surface", () => {
  const found = triangleStrains(restsOf(bent), [1], bent.shape, Uint32Array.from(bent.faces));
  assert.ok(distance(found, bent.strains) < 1e-5 * Math.max(...bent.strains));
});

test("rigid motions have no strain, and that of several rest shapes is the mean square", () => {
  const rests = restsOf(bent);
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
  assert.ok(triangleStrains(rests, [1], turned, faces).every((e) => e < 1e-5));
  const two = [...rests, Float32Array.from(bent.shape)];
  assert.ok(triangleStrains(two, [0, 1], bent.shape, faces).every((e) => e < 1e-5));
  const first = triangleStrains(rests, [1], bent.shape, faces);
  assert.ok(distance(triangleStrains(two, [1, 0], bent.shape, faces), first) < 1e-12);
  const beyond = triangleStrains(two, [-0.2, 1.2], bent.shape, faces);
  assert.ok(
    beyond.every((e) => e === 0),
    "negative sums show as none",
  );
});

test("the scale covers nearly all, and rests while the shape changes little", () => {
  const model = readModel(bytes("posing.packed"), "") as PosingModel;
  const scale = new StrainScale(model.space, [model.space.base], model.faces);
  const q = (size: number) => Float64Array.from({ length: model.dimension }, (_, i) => size / (1 + i));
  assert.equal(scale.look(q(0), [1]), false);
  assert.equal(scale.end, 0.01);
  const size = 0.5 * model.coordinateScale;
  assert.equal(scale.look(q(size), [1]), true);
  const end = scale.end;
  for (const share of [0.99, 0.97, 1]) assert.equal(scale.look(q(share * size), [1]), false);
  scale.look(q(3 * size), [1]);
  assert.ok(scale.end > end);
  scale.look(q(0), [1]);
  assert.equal(scale.end, 0.01);
  assert.deepEqual([0.0013, 0.002, 0.3, 7, 10].map(roundedUp), [0.002, 0.002, 0.5, 10, 10]);
});
