import assert from "node:assert/strict";
import { test } from "node:test";

import { encloses } from "../encloses.ts";

/** A grid of `wide` by `high` vertices; its ends meet along the wide side if it is a tube. */
function grid(wide: number, high: number, isTube = false): { faces: number[]; shape: number[] } {
  const vertex = (i: number, j: number) => (i % wide) + wide * j;
  const [faces, shape]: number[][] = [[], []];
  for (let j = 0; j < high; j++)
    for (let i = 0; i < wide; i++) {
      const angle = (2 * Math.PI * i) / wide;
      shape.push(...(isTube ? [Math.cos(angle), Math.sin(angle), j] : [i, j, 1]));
      if (j === high - 1 || (i === wide - 1 && !isTube)) continue;
      const [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
      faces.push(a, b, c, a, c, d);
    }
  return { faces, shape };
}

/** A tube with a vertex in the middle of each end. */
function can(wide: number, high: number): { faces: number[]; shape: number[] } {
  const { faces, shape } = grid(wide, high, true);
  const [low, top] = [wide * high, wide * high + 1];
  shape.push(0, 0, 0, 0, 0, high - 1);
  for (let i = 0; i < wide; i++) {
    const next = (i + 1) % wide;
    faces.push(next, i, low, i + low - wide, next + low - wide, top);
  }
  return { faces, shape };
}

const isBody = ({ faces, shape }: { faces: number[]; shape: number[] }) =>
  encloses(Uint32Array.from(faces), Float32Array.from(shape));

test("open surfaces enclose nothing, also regular ones", () => {
  for (const wide of [3, 4, 8, 9, 16, 33])
    for (const high of [2, 3, 8, 16, 17])
      for (const isTube of [false, true]) assert(!isBody(grid(wide, high, isTube)), `${wide} x ${high}`);
});

test("closed surfaces enclose a body if they face outward", () => {
  for (const [wide, high] of [
    [3, 2],
    [8, 8],
    [33, 17],
  ]) {
    const { faces, shape } = can(wide, high);
    assert(isBody({ faces, shape }));
    assert(!isBody({ faces: [...faces].reverse(), shape }), "inward");
    assert(!isBody({ faces: faces.slice(3), shape }), "a face is missing");
    const [a, b, c, ...others] = faces;
    assert(!isBody({ faces: [b, a, c, ...others], shape }), "a face is flipped");
  }
});
