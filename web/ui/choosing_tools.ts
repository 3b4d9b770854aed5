import { MOUSE, TOUCH } from "three";

import { NOTHING, union, type ScreenPoint } from "../engine/selecting.ts";
import { listenToPointers } from "./canvas_pointers.ts";
import type { Choosing } from "./choosing.ts";
import type { ToolOverlay } from "./choosing_overlay.ts";

const FINE = 3; // pixels between points of a lasso
const MOST_DABS = 24; // dabs of the brush between two events of the pointer

interface Stroke {
  pointer: number;
  remove: boolean;
  line: ScreenPoint[];
}

/** Brush, box and lasso, with mouse, pen and touch.
 *
 * Everything else moves the camera: presses beside the mesh (brush), the right button, a second finger. */
export class ChoosingTools {
  readonly #choosing: Choosing;
  readonly #overlay: ToolOverlay;
  readonly #canvas: HTMLCanvasElement;
  readonly #fingers = new Set<number>();
  #ownStroke: Stroke | null = null;
  #cursor: ScreenPoint | null = null;

  constructor(choosing: Choosing, overlay: ToolOverlay, signal: AbortSignal) {
    this.#choosing = choosing;
    this.#overlay = overlay;
    this.#canvas = choosing.stage.renderer.canvas;
    const { controls } = choosing.stage;
    const before = { mouse: { ...controls.mouseButtons }, touches: { ...controls.touches } };
    controls.mouseButtons.RIGHT = MOUSE.ROTATE;
    controls.touches.TWO = TOUCH.DOLLY_ROTATE;
    signal.addEventListener("abort", () => {
      controls.mouseButtons = before.mouse;
      controls.touches = before.touches;
      this.#canvas.style.cursor = "";
    });
    const acts = {
      down: this.#down.bind(this),
      move: this.#move.bind(this),
      up: this.#up.bind(this),
      cancel: this.#lift.bind(this),
    };
    listenToPointers(this.#canvas, acts, signal);
    const leave = () => this.#stroke ?? this.#overlay.clear();
    this.#canvas.parentElement!.addEventListener("pointerleave", leave, { capture: true, signal });
  }

  get #stroke(): Stroke | null {
    return this.#ownStroke;
  }

  set #stroke(stroke: Stroke | null) {
    this.#ownStroke = stroke;
    this.#choosing.isBusy = stroke !== null;
  }

  /** Forgets the stroke, and says whether there was one. */
  cancel(): boolean {
    if (!this.#stroke) return false;
    this.#stroke = null;
    this.#overlay.clear();
    this.#choosing.cancel();
    return true;
  }

  /** The keys' brush: a step from where it is, from the middle of the canvas at first. */
  moveCursor(dx: number, dy: number): void {
    const [width, height] = this.#choosing.size;
    const [x, y] = this.#cursor ?? [width / 2, height / 2];
    this.#cursor = [Math.min(Math.max(x + dx, 0), width), Math.min(Math.max(y + dy, 0), height)];
    this.#hover(this.#cursor, this.#choosing.removing);
  }

  /** The keys' brush takes what is below it. */
  dab(remove: boolean): void {
    this.#cursor ??= [this.#choosing.size[0] / 2, this.#choosing.size[1] / 2];
    const center = this.#choosing.hit(this.#cursor);
    if (center) this.#choosing.take(this.#choosing.inBrush(center), remove);
    this.#choosing.commit();
  }

  /** Shows the brush again, as after its size has changed. */
  refresh(): void {
    if (this.#cursor && !this.#stroke) this.#hover(this.#cursor, this.#choosing.removing);
  }

  #down(event: PointerEvent): void {
    if (event.target !== this.#canvas) return;
    if (event.pointerType === "touch") this.#fingers.add(event.pointerId);
    if (this.#fingers.size > 1) {
      this.cancel();
      return;
    }
    if (event.button !== 0 || this.#stroke) return;
    const { tool, stage } = this.#choosing;
    const place = this.#placeOf(event);
    const isTool = tool === "brush" ? this.#choosing.hit(place) !== null : tool !== "look";
    stage.controls.mouseButtons.LEFT = isTool ? null : MOUSE.ROTATE;
    stage.controls.touches.ONE = isTool ? null : TOUCH.ROTATE;
    if (!isTool) return;
    this.#canvas.setPointerCapture(event.pointerId);
    this.#stroke = { pointer: event.pointerId, remove: this.#removes(event), line: [place] };
    if (tool === "brush") this.#brush([place]);
  }

  #move(event: PointerEvent): void {
    const place = this.#placeOf(event);
    this.#cursor = place;
    const stroke = this.#stroke;
    if (!stroke) {
      const isOver = event.target === this.#canvas && event.pointerType !== "touch" && event.buttons === 0;
      if (isOver) this.#hover(place, this.#removes(event));
      else this.#overlay.clear();
      return;
    }
    if (event.pointerId !== stroke.pointer) return;
    const last = stroke.line.at(-1)!;
    const { tool } = this.#choosing;
    if (tool === "brush") {
      this.#brush(this.#between(last, place));
      stroke.line = [place];
    } else if (tool === "box") {
      stroke.line = [stroke.line[0], place];
      this.#overlay.box(stroke.line[0], place, stroke.remove);
    } else if (Math.hypot(place[0] - last[0], place[1] - last[1]) >= FINE) {
      stroke.line.push(place);
      this.#overlay.line(stroke.line, stroke.remove);
    }
  }

  #up(event: PointerEvent): void {
    this.#fingers.delete(event.pointerId);
    const stroke = this.#stroke;
    if (event.pointerId !== stroke?.pointer) return;
    this.#stroke = null;
    this.#overlay.clear();
    const { line, remove } = stroke;
    const choosing = this.#choosing;
    if (choosing.tool !== "brush" && line.length > 1) {
      const found = choosing.tool === "box" ? choosing.inBox(line[0], line[1]) : choosing.inLine(line);
      if (found.length > 0) choosing.take(found, remove);
    }
    choosing.commit();
    if (event.pointerType !== "touch") this.#hover(this.#placeOf(event), this.#removes(event));
  }

  #lift(event: PointerEvent): void {
    this.#fingers.delete(event.pointerId);
    if (event.pointerId === this.#stroke?.pointer) this.cancel();
  }

  #brush(places: ScreenPoint[]): void {
    if (places.length === 0) return;
    const { remove } = this.#stroke!;
    const choosing = this.#choosing;
    let touched = NOTHING;
    for (const place of places) {
      const center = choosing.hit(place);
      if (center) touched = union(touched, choosing.inBrush(center));
    }
    if (touched.length) choosing.take(touched, remove);
    this.#hover(places.at(-1)!, remove);
  }

  /** Places from one to the next, a third of the brush apart. */
  #between(from: ScreenPoint, to: ScreenPoint): ScreenPoint[] {
    const center = this.#choosing.hit(to) ?? this.#choosing.hit(from);
    const step = center ? Math.max(this.#choosing.brushPixels(center) / 3, 2) : 12;
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const count = Math.min(Math.ceil(Math.hypot(dx, dy) / step), MOST_DABS);
    return Array.from({ length: count }, (_, i) => {
      const share = (i + 1) / count;
      return [from[0] + share * dx, from[1] + share * dy] as const;
    });
  }

  #hover(place: ScreenPoint, remove: boolean): void {
    const { tool } = this.#choosing;
    const center = tool === "brush" ? this.#choosing.hit(place) : null;
    if (center) this.#overlay.ring(place, this.#choosing.brushPixels(center), remove);
    else this.#overlay.clear();
    const isBand = tool === "box" || tool === "lasso";
    this.#canvas.style.cursor = center ? "none" : isBand ? "crosshair" : "grab";
  }

  #removes(event: PointerEvent): boolean {
    return event.altKey || (this.#choosing.removing && !event.shiftKey);
  }

  #placeOf(event: PointerEvent): ScreenPoint {
    const box = this.#canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
}
