import { CONFIDENCE, type Certificate } from "../engine/index.ts";
import { h, mark, tell } from "./dom.ts";

/** Estimates up to here are good: a few pixels of a displacement that fills the screen. */
const GOOD = 0.01;

const MEANING = {
  good: "near the full solution",
  rough: "visibly off the full solution",
  outside: "outside of what was sampled: the estimate is a guess",
};

/** How far the shape that is shown is from the full solution: one word and the number behind it. Not there at rest, and
 * where the model cannot tell. */
export class Badge {
  #isPolished = false;
  readonly element = h("p", { className: "badge", role: "status", hidden: true });

  /** What is known of a live shape; `isOutside` of the handle motions or weights that were sampled. */
  show(found: Certificate | null, isOutside: boolean): void {
    if (!found) return this.hide();
    this.#isPolished = false;
    const { relative, upper } = found;
    const level = isOutside ? "outside" : relative <= GOOD ? "good" : "rough";
    const bound = upper === null ? "" : `; below ${percent(upper)} with ${percent(CONFIDENCE)} confidence`;
    const title = `${MEANING[level]}: an estimated ${percent(relative)} of the displacement${bound}`;
    this.#set(level, `${level} ${percent(relative)}`, title);
  }

  /** The shape is another one: what full iterations gave is over. */
  forgetPolish(): void {
    if (this.#isPolished) this.hide();
  }

  /** A shape that full iterations have moved, by this share of the displacement. */
  polished(moved: number | null): void {
    const by = moved === null ? "" : `, moved ${percent(moved)}`;
    this.#isPolished = true;
    this.#set("good", `polished${by}`, "the live shape after a few iterations in the full space");
  }

  hide(): void {
    this.#isPolished = false;
    if (!this.element.hidden) this.element.hidden = true;
  }

  #set(level: string, text: string, title: string): void {
    mark(this.element, "data-level", level);
    tell(this.element, text);
    this.element.title = title;
    this.element.hidden = false;
  }
}

const percent = (share: number) => `${Number((100 * share).toPrecision(2))} %`;
