import { Color, Group, Quaternion, Vector3 } from "three";

import { Geometry, material, Mesh, PLACED, quad, SCREEN, type Uniform } from "../render/index.ts";
import { AXIS_COLORS } from "./axis_colors.ts";

/** Lengths as shares of the gizmo's size: the ends of arrows, the sides of squares between two arrows, and the radii of the
 * rings about the axes and about the view. */
export const ARROW = [0.12, 1] as const;
export const SQUARE = [0.26, 0.5] as const;
export const [RING, VIEW_RING] = [0.85, 1.05];
/** How far behind the middle a ring is drawn, as a share of its radius. */
export const BEHIND = 0.2;

/** Colour of the part that the pointer is on. */
export const ACTIVE = "#ffd23f";
const VIEW_COLOR = "#9aa3b0";
const SQUARE_OPACITY = 0.45;
const [SHAFT, HEAD, HEAD_START] = [0.014, 0.065, 0.8];
const TUBE = 0.014;
const Y = new Vector3(0, 1, 0);
const UNITS = [new Vector3(1, 0, 0), Y, new Vector3(0, 0, 1)];

/** An arrow moves along an axis, a square across one, and a ring turns about one. */
export type PartKind = "arrow" | "square" | "ring" | "view";

/** Rings without what is behind. */
const FRAGMENT = `
uniform mat4 model;
uniform vec3 eye, color;
uniform float opacity;
uniform bool isRing;
in vec3 place;
out vec4 shown;
${SCREEN}
void main() {
  vec3 middle = model[3].xyz, away = place - middle;
  if (isRing && dot(away, normalize(eye - middle)) < -${BEHIND} * length(away)) discard;
  shown = vec4(onScreen(color), opacity);
}`;

/** A part of the gizmo that can be taken hold of. */
export class GizmoPart {
  readonly kind: PartKind;
  /** 0, 1 or 2; -1 for the ring about the view. */
  readonly axis: number;
  readonly mesh: Mesh;
  readonly #color: Uniform<number[]> = { value: [] };

  constructor(kind: PartKind, axis: number, geometry: Geometry) {
    [this.kind, this.axis] = [kind, axis];
    const opacity = kind === "square" ? SQUARE_OPACITY : 1;
    const uniforms = {
      color: this.#color,
      opacity: { value: opacity },
      isRing: { value: kind === "ring" },
    };
    const look = { isTransparent: true, depthTest: false, depthWrite: false };
    this.mesh = new Mesh(geometry, material({ vertex: PLACED, fragment: FRAGMENT, uniforms }, look));
    this.mesh.renderOrder = kind === "square" ? 6 : 7; // after the dots of handles
    if (kind === "arrow" || kind === "ring") this.mesh.quaternion.setFromUnitVectors(Y, UNITS[axis]);
    this.isActive = false;
  }

  /** Its colour as it is shown. */
  get color(): string {
    return `#${new Color(...this.#color.value).getHexString()}`;
  }

  set isActive(on: boolean) {
    const own = this.axis < 0 ? VIEW_COLOR : AXIS_COLORS[this.axis];
    this.#color.value = new Color(on ? ACTIVE : own).toArray();
  }
}

/** All parts, in a group whose axes are those of the arrows and whose scale is their length. */
export class GizmoParts {
  readonly group = new Group();
  readonly all: readonly GizmoPart[];
  readonly #geometries: readonly Geometry[];

  constructor() {
    const [arrow, ring, view] = [arrowAlongY(), ringAboutY(RING), ringAboutY(VIEW_RING)];
    const squares = UNITS.map((_, axis) => squareAcross(axis));
    this.#geometries = [arrow, ring, view, ...squares];
    this.all = [
      ...squares.map((square, axis) => new GizmoPart("square", axis, square)),
      ...UNITS.map((_, axis) => new GizmoPart("arrow", axis, arrow)),
      ...UNITS.map((_, axis) => new GizmoPart("ring", axis, ring)),
      new GizmoPart("view", -1, view),
    ];
    this.group.add(...this.all.map(({ mesh }) => mesh));
    this.group.name = "gizmo";
    this.group.visible = false;
  }

  /** Turns the ring about the view, in the axes of the group, towards the camera. */
  face(direction: Vector3, axes: Quaternion): void {
    const own = direction.clone().applyQuaternion(axes.clone().invert());
    this.all.at(-1)!.mesh.quaternion.setFromUnitVectors(Y, own);
  }

  dispose(): void {
    this.group.removeFromParent();
    this.#geometries.forEach((geometry) => geometry.dispose());
  }
}

function arrowAlongY(): Geometry {
  const [start, end] = ARROW;
  return grid(
    [
      [SHAFT, start],
      [SHAFT, HEAD_START],
      [HEAD, HEAD_START],
      [0, end],
    ].map(([radius, y]) => (angle) => [radius * Math.cos(angle), y, radius * Math.sin(angle)]),
    12,
  );
}

function ringAboutY(radius: number): Geometry {
  const sides = 8;
  const circle = Array.from({ length: sides + 1 }, (_, i) => (2 * Math.PI * i) / sides);
  return grid(
    circle.map((around) => (angle) => {
      const away = radius + TUBE * Math.cos(around);
      return [away * Math.cos(angle), TUBE * Math.sin(around), away * Math.sin(angle)];
    }),
    96,
  );
}

/** The surface through closed lines: points at angles on one line and on the next. */
function grid(lines: readonly ((angle: number) => number[])[], count: number): Geometry {
  const position: number[] = [];
  const faces: number[] = [];
  lines.forEach((line, row) => {
    for (let i = 0; i < count; i++) {
      position.push(...line((2 * Math.PI * i) / count));
      if (row === 0) continue;
      const [here, next] = [row * count + i, row * count + ((i + 1) % count)];
      faces.push(here, next, here - count, next, next - count, here - count);
    }
  });
  return new Geometry({ position: { data: new Float32Array(position), size: 3 } }, new Uint32Array(faces));
}

function squareAcross(axis: number): Geometry {
  const [from, to] = SQUARE;
  const corner = (a: number, b: number) => {
    const place: [number, number, number] = [0, 0, 0];
    [place[(axis + 1) % 3], place[(axis + 2) % 3]] = [a, b];
    return place;
  };
  return quad(corner(from, from), corner(to, from), corner(to, to), corner(from, to));
}
