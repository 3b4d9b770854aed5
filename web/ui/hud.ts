import type { Certificate, FrameReport } from "../engine/index.ts";
import { Badge } from "./badge.ts";
import { h, setText } from "./dom.ts";

const STATUS: Partial<Record<FrameReport["status"], string>> = {
  max_iterations: "stopped early",
  max_evaluations: "stopped early",
  not_finite: "not finite",
  unbounded: "no minimum here",
};

const PAUSE = 120; // milliseconds without another frame

/** What a view shows at the moment. */
export interface Shown {
  /** How far the shape is from the full solution; null where that is not known. */
  certificate(): Certificate | null;
  /** What is outside the handle motions or weights that were sampled. */
  readonly outside: readonly unknown[];
}

/** Dimension, time of a solve, frame rate and a badge of the error, in a corner; and a warning below. */
export class Hud {
  readonly element: HTMLElement;
  readonly #warning = h("span");
  readonly notice = h("p", { className: "notice", role: "status" }, this.#warning);
  readonly #figures = {
    d: figure("d", "coordinates"),
    solve: figure("solve", "of one solve"),
    fps: figure("fps", ""),
  };
  readonly #remark = h("p", { role: "status" });
  readonly badge = new Badge();
  readonly #shown: () => Shown;
  #certifying = 0;
  #stopped: string | undefined;
  readonly #solves: number[] = [];
  readonly #frames: number[] = [];

  constructor(title: string, detail: string, shown: () => Shown) {
    const { d, solve, fps } = this.#figures;
    this.#shown = shown;
    this.element = h(
      "header",
      { className: "hud" },
      h("h1", {}, title),
      h("p", {}, detail),
      h("dl", {}, ...d.nodes, ...solve.nodes, ...fps.nodes),
      this.badge.element,
      this.#remark,
    );
    this.warn("");
  }

  dimension(d: number, whole: number): void {
    setText(this.#figures.d.value, d === whole ? String(d) : `${d} of ${whole}`);
  }

  solved(report: FrameReport): void {
    keep(this.#solves, report.milliseconds);
    this.#stopped = STATUS[report.status];
    this.badge.forgetPolish();
    // only when a drag pauses: nobody looks at the frames before
    clearTimeout(this.#certifying);
    this.#certifying = window.setTimeout(() => this.assess(), PAUSE);
  }

  /** The shape that is shown comes from full iterations, which moved it by this share: no estimate follows. */
  polished(moved: number | null): void {
    clearTimeout(this.#certifying);
    this.badge.polished(moved);
  }

  dispose(): void {
    clearTimeout(this.#certifying);
  }

  /** Counts the time since the frame before, unless it was a pause. */
  frame(seconds: number): void {
    if (seconds > 0.5) this.#frames.length = 0;
    else keep(this.#frames, seconds);
  }

  /** Shows time and rate, and says whether they have changed. */
  update(): boolean {
    const { solve, fps } = this.#figures;
    const took = this.#stopped ?? (this.#solves.length ? `${mean(this.#solves).toFixed(2)} ms` : "–");
    const isOther = setText(solve.value, took);
    return (this.#frames.length > 3 && setText(fps.value, (1 / mean(this.#frames)).toFixed(0))) || isOther;
  }

  /** A remark on the shape that is shown, or an empty text. */
  remark(text: string): void {
    setText(this.#remark, text);
  }

  /** Shows a warning, or hides it for an empty text, and says whether it has changed. It keeps its place, so that
   * hiding it causes no layout. */
  warn(text: string): boolean {
    this.notice.style.visibility = text ? "" : "hidden";
    return setText(this.#warning, text);
  }

  /** Shows the error of the live shape. */
  assess(): void {
    const shown = this.#shown();
    this.badge.show(shown.certificate(), shown.outside.length > 0);
  }
}

function figure(name: string, title: string) {
  const value = h("dd", {}, "–");
  return { value, nodes: [h("dt", { title }, name), value] };
}

function keep(values: number[], value: number): void {
  values.push(value);
  if (values.length > 30) values.shift();
}

const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
