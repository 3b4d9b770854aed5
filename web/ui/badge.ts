import { CONFIDENCE, type Certificate } from "../engine/index.ts";
import { h, mark, setText } from "./dom.ts";

/** Estimates up to here are good: a few pixels of a displacement that fills the screen. */
const GOOD = 0.01;

const MEANING = {
  good: "near the full solution",
  rough: "visibly off the full solution",
  outside: "outside the sampled range: the estimate is a guess",
};

/** How far the shape that is shown is from the full solution: one word and the number. Hidden at rest, and
 * where the model has no estimate. */
export class Badge {
  #isPolished = false;
  readonly element = h("p", { className: "badge", role: "status", hidden: true });

  /** Shows the error of a live shape; `isOutside` says whether handles or weights are outside the sampled range. */
  show(found: Certificate | null, isOutside: boolean): void {
    if (!found) return this.hide();
    this.#isPolished = false;
    const { relative, upper } = found;
    const level = isOutside ? "outside" : relative <= GOOD ? "good" : "rough";
    const bound = upper === null ? "" : `; below ${percent(upper)} with ${percent(CONFIDENCE)} confidence`;
    const title = `${MEANING[level]}: an estimated ${percent(relative)} of the displacement${bound}`;
    this.#set(level, `${level} ${percent(relative)}`, title);
  }

  /** Hides the result of full iterations, because another shape is shown. */
  forgetPolish(): void {
    if (this.#isPolished) this.hide();
  }

  /** Shows that full iterations moved the shape, by this share of the displacement. Where they moved it far, they have not
   * ended near the solution. */
  polished(moved: number | null): void {
    const by = moved === null ? "" : `, moved ${percent(moved)}`;
    this.#isPolished = true;
    const level = (moved ?? 0) > GOOD ? "rough" : "good";
    this.#set(level, `polished${by}`, "the live shape after a few iterations in the full space");
  }

  hide(): void {
    this.#isPolished = false;
    if (!this.element.hidden) this.element.hidden = true;
  }

  #set(level: string, text: string, title: string): void {
    mark(this.element, "data-level", level);
    setText(this.element, text);
    this.element.title = title;
    this.element.hidden = false;
  }
}

const percent = (share: number) => `${Number((100 * share).toPrecision(2))} %`;
