import { Color } from "three";

import type { PosingModel } from "../engine/index.ts";
import { CLAY, handleColor } from "./handle_colors.ts";
import type { Surface } from "./surface.ts";

const WHITE = new Color("#ffffff");
const LIGHTER = 0.1; // towards white

/** The colours of handles on a surface; the selected one is a little lighter. */
export class HandlePaint {
  readonly #surface: Surface;
  /** Surface vertices of each handle. */
  readonly #vertices: number[][];

  /** Colours the whole surface. */
  constructor(surface: Surface, { handles, handleOfVertex }: PosingModel, selected: number) {
    this.#surface = surface;
    this.#vertices = handles.map(() => []);
    handleOfVertex.forEach((handle, vertex) => this.#vertices[handle]?.push(vertex));
    const colors = handles.map((_, handle) => colorOf(handle, handle === selected));
    surface.paint((vertex) => colors[handleOfVertex[vertex]] ?? CLAY);
  }

  /** Colours one handle. */
  paint(handle: number, isSelected: boolean): void {
    this.#surface.paintSome(this.#vertices[handle], colorOf(handle, isSelected));
  }
}

function colorOf(handle: number, isSelected: boolean): Color {
  const color = new Color(handleColor(handle));
  return isSelected ? color.lerp(WHITE, LIGHTER) : color;
}
