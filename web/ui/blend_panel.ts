import { PLAIN_ENDS, type WeightEnds } from "../engine/index.ts";
import { BlendPolygon } from "./blend_polygon.ts";
import { h, section, slider } from "./dom.ts";
import {
  inEqualParts,
  MOST_CHOSEN,
  reweighted,
  withoutPose,
  withPose,
  type PoseChoice,
} from "./pose_choice.ts";
import { PoseList } from "./pose_list.ts";
import { sliderEnds } from "./slider_ends.ts";
import { WeightRows } from "./weight_rows.ts";

/** The controls of a blend: polygon and sliders of the poses that take part; for many poses, a list to choose them
 * from. */
export interface BlendPanel {
  readonly sections: HTMLElement[];
  /** The field for a search; null for few poses. */
  readonly search: HTMLInputElement | null;
  show(choice: PoseChoice): void;
  /** Lets sliders go as far as `endsOf` says of the poses that take part; null: from 0 to 100 %. */
  extend(endsOf: EndsOf | null): void;
  /** Shows a picture of a pose everywhere in the panel. */
  illustrate(pose: number, address: string): void;
}

/** The smallest and the largest weight of one of some poses. */
export type EndsOf = (poses: readonly number[], pose: number) => WeightEnds;
/** Milliseconds. */
const TURN = 8;
const plainEnds: EndsOf = () => PLAIN_ENDS;

/** `act` gets what the user asks for. Few poses all take part, many are chosen. */
export function blendPanel(
  names: readonly string[],
  buttons: readonly HTMLElement[],
  act: (choice: PoseChoice) => void,
): BlendPanel {
  const row = h("div", { className: "row" }, ...buttons);
  const place = new PolygonPlace(names, act);
  return names.length > MOST_CHOSEN ? choosing(names, place, row, act) : whole(names, place, row, act);
}

/** All poses take part. */
function whole(
  names: readonly string[],
  place: PolygonPlace,
  row: HTMLElement,
  act: (choice: PoseChoice) => void,
): BlendPanel {
  let shown = inEqualParts(names.map((_, pose) => pose));
  const percent = (w: number) => `${Math.round(100 * w)} %`;
  const sliders = names.map((name, pose) =>
    slider(name, { min: 0, max: 1, step: 0.001, value: shown.weights[pose] }, percent, (w) =>
      act(reweighted(shown, pose, w)),
    ),
  );
  const ends = sliders.map(({ element, input }) => {
    const own = sliderEnds(input);
    element.append(own.element);
    return own;
  });
  const extend = inTurns((pose, limits) => ends[pose].set(limits));
  return {
    sections: [
      section("Blend", place.element, row),
      section("Poses", ...sliders.map(({ element }) => element)),
    ],
    search: null,
    show: (choice) => {
      shown = choice;
      place.show(choice);
      sliders.forEach(({ set }, pose) => set(choice.weights[pose]));
    },
    extend: (endsOf) => extend(shown.poses, endsOf ?? plainEnds),
    illustrate: (pose, address) => place.illustrate(pose, address),
  };
}

/** Some poses take part. The list comes first, and keeps its height: nothing moves away while one chooses. */
function choosing(
  names: readonly string[],
  place: PolygonPlace,
  row: HTMLElement,
  act: (choice: PoseChoice) => void,
): BlendPanel {
  let shown = inEqualParts([0]);
  const list = new PoseList(names, (pose) =>
    act(shown.poses.includes(pose) ? withoutPose(shown, pose) : withPose(shown, pose)),
  );
  const rows = new WeightRows(names, {
    weigh: (at, weight) => act(reweighted(shown, at, weight)),
    remove: (pose) => act(withoutPose(shown, pose)),
  });
  place.element.classList.add("steady");
  let endsOf = plainEnds;
  const extend = inTurns((at, limits) => rows.extend(at, limits));
  return {
    sections: [section("Poses", list.element), section("Blend", place.element, row, rows.element)],
    search: list.search,
    show: (choice) => {
      if (choice.poses !== shown.poses) {
        list.show(choice.poses);
        extend(choice.poses, endsOf);
      }
      shown = choice;
      place.show(choice);
      rows.show(choice, place.pictures);
    },
    extend: (given) => {
      endsOf = given ?? plainEnds;
      extend(shown.poses, endsOf);
    },
    illustrate: (pose, address) => {
      place.illustrate(pose, address);
      list.illustrate(pose, address);
      rows.show(shown, place.pictures);
    },
  };
}

/** Sets the ends of one slider after the other. What takes longer than a picture continues in later tasks, until the
 * next call. */
function inTurns(set: (place: number, limits: WeightEnds) => void) {
  let later = 0;
  return (poses: readonly number[], endsOf: EndsOf) => {
    clearTimeout(later);
    const go = (place: number) => {
      const begin = performance.now();
      for (; place < poses.length && performance.now() < begin + TURN; place++)
        set(place, endsOf(poses, poses[place]));
      if (place < poses.length) later = window.setTimeout(() => go(place));
    };
    go(0);
  };
}

/** The place of the polygon, which is made again for each choice of poses. */
class PolygonPlace {
  readonly element = h("div");
  /** Addresses of pictures by pose. */
  readonly pictures: (string | undefined)[];
  readonly #names: readonly string[];
  readonly #act: (choice: PoseChoice) => void;
  #polygon: BlendPolygon | null = null;
  #poses: readonly number[] = [];

  constructor(names: readonly string[], act: (choice: PoseChoice) => void) {
    this.#names = names;
    this.#act = act;
    this.pictures = names.map(() => undefined);
  }

  show({ poses, weights }: PoseChoice): void {
    if (!sameNumbers(poses, this.#poses)) this.#make(poses);
    this.#polygon?.show(weights);
  }

  illustrate(pose: number, address: string): void {
    this.pictures[pose] = address;
    const corner = this.#poses.indexOf(pose);
    if (corner >= 0) this.#polygon?.illustrate(corner, address);
  }

  #make(poses: readonly number[]): void {
    this.#poses = poses;
    if (poses.length < 2) {
      this.#polygon = null;
      const hint = h("p", { className: "hint" }, "Choose another pose to blend with.");
      this.element.replaceChildren(hint);
      return;
    }
    const names = poses.map((pose) => this.#names[pose]);
    this.#polygon = new BlendPolygon(names, (weights) => this.#act({ poses, weights }));
    this.element.replaceChildren(this.#polygon.element);
    poses.forEach((pose) => {
      const address = this.pictures[pose];
      if (address) this.illustrate(pose, address);
    });
  }
}

function sameNumbers(a: readonly number[], b: readonly number[]): boolean {
  return a.length === b.length && a.every((value, i) => value === b[i]);
}
