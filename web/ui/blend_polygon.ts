import { clampedInto, meanValueCoordinates, regularPolygon } from "./barycentric.ts";

const SVG = "http://www.w3.org/2000/svg";
const RADIUS = 70;
const OUT = RADIUS + 16; // where the pictures are
const PICTURE = 38;

/** Two or more poses as corners of a polygon, and a point in it that is dragged: its coordinates are the weights. */
export class BlendPolygon {
  readonly element: SVGSVGElement;
  readonly #corners: [number, number][];
  readonly #dot: SVGElement;
  readonly #pictures: SVGElement[] = [];
  readonly #act: (weights: number[]) => void;
  #weights: readonly number[] = [];
  /** The weights when the present drag began. */
  #before: readonly number[] | null = null;

  /** `act` gets the weights of the dragged point, and of a corner that is clicked. */
  constructor(names: readonly string[], act: (weights: number[]) => void) {
    this.#corners = regularPolygon(names.length);
    this.#act = act;
    const heights = this.#corners.map(([, y]) => OUT * y);
    const [top, bottom] = [Math.min(...heights), Math.max(...heights)];
    const margin = PICTURE / 2 + 4;
    const box = [-OUT - margin, top - margin, 2 * (OUT + margin), bottom - top + 2 * margin];
    this.element = svg("svg", {
      viewBox: box.join(" "),
      class: "polygon",
      role: "slider",
      tabindex: 0,
      "aria-label": "Blend of the poses; arrow keys move the point",
      "aria-valuetext": "",
    }) as SVGSVGElement;
    const outline = this.#corners.map(([x, y]) => `${RADIUS * x},${RADIUS * y}`).join(" ");
    this.element.append(svg("polygon", { points: outline, class: "outline" }));
    this.#corners.forEach(([x, y], i) => {
      const corner = svg("g", { class: "corner" });
      const [cx, cy] = [OUT * x, OUT * y];
      const inside = 0.84 * PICTURE; // the corners of the picture are near the circle
      const [left, above] = [cx - inside / 2, cy - inside / 2];
      const picture = svg("image", { x: left, y: above, width: inside, height: inside });
      this.#pictures.push(picture);
      const title = svg("title", {});
      title.textContent = names[i];
      corner.append(svg("circle", { cx, cy, r: PICTURE / 2 }), picture, title);
      corner.addEventListener("click", () => act(names.map((_, k) => (k === i ? 1 : 0))));
      this.element.append(corner);
    });
    this.#dot = svg("circle", { r: 8, class: "dot" });
    this.element.append(this.#dot);
    this.#listen();
  }

  /** Shows a picture of a pose at its corner. */
  illustrate(pose: number, address: string): void {
    this.#pictures[pose].setAttribute("href", address);
  }

  show(weights: readonly number[]): void {
    this.#weights = weights;
    const sum = (axis: 0 | 1) => weights.reduce((total, w, i) => total + w * this.#corners[i][axis], 0);
    const isBeyond = Math.min(...weights) < 0; // on the edge then, as a ring
    const [x, y] = isBeyond ? clampedInto(this.#corners, sum(0), sum(1)) : [sum(0), sum(1)];
    this.#dot.setAttribute("cx", String(RADIUS * x));
    this.#dot.setAttribute("cy", String(RADIUS * y));
    this.#dot.classList.toggle("beyond", isBeyond);
    this.element.setAttribute("aria-valuetext", weights.map((w) => `${Math.round(100 * w)} %`).join(", "));
  }

  #listen(): void {
    const follow = (event: PointerEvent) => {
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(
        this.element.getScreenCTM()!.inverse(),
      );
      this.#goTo(at.x / RADIUS, at.y / RADIUS);
    };
    this.element.addEventListener("pointerdown", (event) => {
      if ((event.target as Element).closest(".corner")) return;
      this.element.setPointerCapture(event.pointerId);
      this.#before = this.#weights;
      follow(event);
    });
    this.element.addEventListener("lostpointercapture", () => (this.#before = null));
    this.element.addEventListener("pointermove", (event) => {
      if (this.#before && this.element.hasPointerCapture(event.pointerId)) follow(event);
    });
    this.element.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && this.#before) {
        this.#act([...this.#before]);
        this.#before = null; // the pointer has no effect until it is released
      }
      const steps: Record<string, [number, number]> = {
        ArrowLeft: [-1, 0],
        ArrowRight: [1, 0],
        ArrowUp: [0, -1],
        ArrowDown: [0, 1],
      };
      const step = steps[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopPropagation();
      const at = (name: string) => Number(this.#dot.getAttribute(name)) / RADIUS;
      this.#goTo(at("cx") + 0.05 * step[0], at("cy") + 0.05 * step[1]);
    });
  }

  #goTo(x: number, y: number): void {
    const [px, py] = clampedInto(this.#corners, x, y);
    this.#act(meanValueCoordinates(this.#corners, px, py));
  }
}

function svg(name: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
}
