import { Vector3, type Color } from "three";

import type { Choice } from "../engine/choice.ts";
import type { Vector } from "../engine/motion.ts";
import type { RestMesh } from "../engine/rest_mesh.ts";
import {
  inBall,
  inLasso,
  inRectangle,
  nearestTo,
  NOTHING,
  placesOf,
  seenFrom,
  union,
  without,
  type ScreenPoint,
} from "../engine/selecting.ts";
import { TriangleTree } from "../engine/triangle_tree.ts";
import { inWindow, rayThrough } from "./canvas_ray.ts";
import { ownerColors } from "./choosing_colors.ts";
import { History } from "./history.ts";
import type { Stage } from "./stage.ts";
import type { Surface } from "./surface.ts";

export type Tool = "brush" | "box" | "lasso" | "look";

/** The state of choosing: the selection, handles and parts, the tool, and the history. */
export class Choosing {
  readonly stage: Stage;
  readonly mesh: RestMesh;
  readonly surface: Surface;
  tool: Tool = "brush";
  /** Whether tools deselect vertices. */
  removing = false;
  /** Whether a tool is in use: until its stroke ends, there is no undo, and no handle is made of what it selects. */
  isBusy = false;
  /** Whether box and lasso select only what is seen, and not what lies behind or inside. */
  seenOnly = false;
  /** The brush's radius as a share of the mesh's diagonal. */
  radius = 0.05;
  /** After anything that controls show has changed. */
  onChange: () => void = () => {};
  readonly #history: History<Choice>;
  readonly #tree: TriangleTree;
  readonly #owners: Uint8Array;
  #choice: Choice;
  #stroke: Int32Array | null = null;
  #isPainted = false;

  constructor(stage: Stage, mesh: RestMesh, surface: Surface, choice: Choice) {
    this.stage = stage;
    this.mesh = mesh;
    this.surface = surface;
    this.#choice = choice;
    this.#history = new History(choice);
    this.#tree = new TriangleTree(mesh.shape, mesh.faces);
    this.#owners = new Uint8Array(mesh.shape.length / 3);
  }

  get choice(): Choice {
    return this.#choice;
  }

  /** The selected vertices, with those of the present stroke. */
  get selected(): Int32Array {
    return this.#stroke ?? this.#choice.selected;
  }

  /** Sets the choice, as a step that can be undone. */
  go(choice: Choice): void {
    this.#stroke = null;
    this.#choice = choice;
    this.#history.push(choice);
    this.changed();
  }

  /** A part of a stroke: adds vertices to the selection, or removes them. */
  take(vertices: Int32Array, remove: boolean): void {
    this.#stroke = remove ? without(this.selected, vertices) : union(this.selected, vertices);
    this.changed();
  }

  /** Ends a stroke. */
  commit(): void {
    if (this.#stroke) this.go({ ...this.#choice, selected: this.#stroke });
  }

  /** Forgets a stroke. */
  cancel(): void {
    this.#stroke = null;
    this.changed();
  }

  clear(): void {
    if (this.selected.length) this.go({ ...this.#choice, selected: NOTHING });
  }

  get canUndo(): boolean {
    return this.#history.canUndo;
  }

  get canRedo(): boolean {
    return this.#history.canRedo;
  }

  undo(): void {
    if (!this.isBusy) this.#restore(this.#history.undo());
  }

  redo(): void {
    if (!this.isBusy) this.#restore(this.#history.redo());
  }

  /** Updates controls and stage. */
  changed(): void {
    this.#isPainted = false;
    this.onChange();
    this.stage.draw();
  }

  /** Colours the surface, before a picture. */
  paint(): void {
    if (this.#isPainted) return;
    this.#isPainted = true;
    const colors = ownerColors(this.#choice, this.#owners, this.selected);
    this.surface.paint((vertex): Color => colors[this.#owners[vertex]]);
  }

  /** Where a point of the canvas hits the mesh, in the mesh's frame; null for a miss. */
  hit([x, y]: ScreenPoint): Vector | null {
    const { camera, root } = this.stage;
    const [width, height] = this.size;
    const seen = rayThrough(camera, [(2 * x) / width - 1, 1 - (2 * y) / height]);
    const { origin, direction } = seen.applyMatrix4(root.matrixWorld.clone().invert());
    const found = this.#tree.hit(origin.toArray(), direction.toArray());
    return found && origin.addScaledVector(direction, found.along).toArray();
  }

  /** One vertex at least: in the middle of a large triangle the brush takes its nearest corner. */
  inBrush(center: Vector): Int32Array {
    const { shape, diagonal } = this.mesh;
    const found = inBall(shape, center, this.radius * diagonal);
    return found.length > 0 ? found : nearestTo(shape, center);
  }

  /** How large the brush is on the screen where it hits, in pixels. */
  brushPixels(center: Vector): number {
    const { camera, root } = this.stage;
    const depth = new Vector3(...center)
      .applyMatrix4(root.matrixWorld)
      .applyMatrix4(camera.matrixWorldInverse).z;
    const focal = this.size[1] / (2 * Math.tan((camera.fov * Math.PI) / 360));
    return (this.radius * this.mesh.diagonal * root.scale.x * focal) / Math.max(-depth, camera.near);
  }

  inBox(from: ScreenPoint, to: ScreenPoint): Int32Array {
    return this.#open(inRectangle(this.#places(), from, to));
  }

  inLine(line: readonly ScreenPoint[]): Int32Array {
    return this.#open(inLasso(this.#places(), line));
  }

  /** The position of a vertex in the window. */
  screen(vertex: number): [number, number] {
    const place = new Vector3().fromArray(this.mesh.shape, 3 * vertex);
    return inWindow(this.stage, place.applyMatrix4(this.stage.root.matrixWorld));
  }

  /** Width and height of the canvas in pixels of the page. */
  get size(): [number, number] {
    const { clientWidth, clientHeight } = this.stage.renderer.canvas;
    return [clientWidth, clientHeight];
  }

  #places(): Float32Array {
    const { camera, root } = this.stage;
    const matrix = camera.projectionMatrix
      .clone()
      .multiply(camera.matrixWorldInverse)
      .multiply(root.matrixWorld);
    return placesOf(this.mesh.shape, matrix.elements, ...this.size);
  }

  #open(vertices: Int32Array): Int32Array {
    if (!this.seenOnly) return vertices;
    const eye = this.stage.root.worldToLocal(this.stage.camera.position.clone());
    return seenFrom(eye.toArray(), this.#tree, this.mesh.shape, this.mesh.faces, vertices);
  }

  #restore(choice: Choice | undefined): void {
    if (!choice) return;
    this.#stroke = null;
    this.#choice = choice;
    this.changed();
  }
}
