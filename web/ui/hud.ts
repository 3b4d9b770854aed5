import { CONFIDENCE, type Certificate, type FrameReport } from "../engine/index.ts";
import { h, tell } from "./dom.ts";

const STATUS: Partial<Record<FrameReport["status"], string>> = {
  max_iterations: "stopped early",
  max_evaluations: "stopped early",
  not_finite: "beyond all numbers",
  unbounded: "no minimum here",
};

const PAUSE = 120; // milliseconds without another frame

/** Dimension, time of a solve and rate of frames, in a corner; and what the user should know, below. */
export class Hud {
  readonly element: HTMLElement;
  readonly #warning = h("span");
  readonly notice = h("p", { className: "notice", role: "status" }, this.#warning);
  readonly #figures = {
    d: figure("d", "coordinates"),
    solve: figure("solve", "of one solve"),
    fps: figure("fps", ""),
    error: figure("error", "estimated distance from the full solution, of the displacement"),
  };
  readonly #remark = h("p", { role: "status" });
  readonly #certify: (() => Certificate | null) | null;
  #certifying = 0;
  #stopped: string | undefined;
  readonly #solves: number[] = [];
  readonly #frames: number[] = [];

  /** `certify` tells the error of the present frame; without it there is no such figure. */
  constructor(title: string, detail: string, certify: (() => Certificate | null) | null = null) {
    const { d, solve, fps, error } = this.#figures;
    this.#certify = certify;
    this.element = h(
      "header",
      { className: "hud" },
      h("h1", {}, title),
      h("p", {}, detail),
      h("dl", {}, ...d.nodes, ...solve.nodes, ...fps.nodes, ...(certify ? error.nodes : [])),
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
    // once a drag pauses: certificates are not for frames that nobody looks at
    clearTimeout(this.#certifying);
    if (this.#certify) this.#certifying = window.setTimeout(() => this.#tellError(), PAUSE);
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

  #tellError(): void {
    const { value } = this.#figures.error;
    const found = this.#certify!();
    const bound = found?.upper == null ? "" : ` (< ${percent(found.upper)})`;
    tell(value, found ? percent(found.relative) + bound : "–");
    value.title = bound ? `below ${percent(found!.upper!)} with ${percent(CONFIDENCE)} confidence` : "";
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

const percent = (share: number) => `${Number((100 * share).toPrecision(2))} %`;
const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
