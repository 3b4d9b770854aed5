import type { Certificate, FrameReport } from "../engine/index.ts";
import { Badge } from "./badge.ts";
import { h, tell } from "./dom.ts";

const STATUS: Partial<Record<FrameReport["status"], string>> = {
  max_iterations: "stopped early",
  max_evaluations: "stopped early",
  not_finite: "beyond all numbers",
  unbounded: "no minimum here",
};

const PAUSE = 120; // milliseconds without another frame

/** What a view shows at the moment. */
export interface Shown {
  /** How far the shape is from the full solution; null where nothing is known of it. */
  certificate(): Certificate | null;
  /** What is beyond the handle motions or weights that were sampled. */
  readonly outside: readonly unknown[];
}

/** Dimension, time of a solve, rate of frames and a badge of the error, in a corner; and what the user should know, below. */
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
    tell(this.#figures.d.value, d === whole ? String(d) : `${d} of ${whole}`);
  }

  solved(report: FrameReport): void {
    keep(this.#solves, report.milliseconds);
    this.#stopped = STATUS[report.status];
    this.badge.forgetPolish();
    // once a drag pauses: certificates are not for frames that nobody looks at
    clearTimeout(this.#certifying);
    this.#certifying = window.setTimeout(() => this.assess(), PAUSE);
  }

  /** The shape that is shown comes from full iterations, which moved it by this share: no estimate comes after that. */
  polished(moved: number | null): void {
    clearTimeout(this.#certifying);
    this.badge.polished(moved);
  }

  dispose(): void {
    clearTimeout(this.#certifying);
  }

  /** Time since the frame before; long ones are pauses. */
  frame(seconds: number): void {
    if (seconds > 0.5) this.#frames.length = 0;
    else keep(this.#frames, seconds);
  }

  /** Tells time and rate; whether they are other ones. */
  tell(): boolean {
    const { solve, fps } = this.#figures;
    const took = this.#stopped ?? (this.#solves.length ? `${mean(this.#solves).toFixed(2)} ms` : "–");
    const isOther = tell(solve.value, took);
    return (this.#frames.length > 3 && tell(fps.value, (1 / mean(this.#frames)).toFixed(0))) || isOther;
  }

  /** A remark on the shape that is shown, or an empty text. */
  remark(text: string): void {
    tell(this.#remark, text);
  }

  /** What must be known, or an empty text; whether it is another one. It has its place always: to hide it lays
   * nothing out. */
  warn(text: string): boolean {
    this.notice.style.visibility = text ? "" : "hidden";
    return tell(this.#warning, text);
  }

  /** Tells the error of the live shape. */
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
