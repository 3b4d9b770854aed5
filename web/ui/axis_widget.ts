import { Quaternion, Vector3 } from "three";

import { AXIS_COLORS } from "./axis_colors.ts";
import type { Axis, Stage } from "./stage.ts";

const SVG = "http://www.w3.org/2000/svg";
const [SIZE, REACH, RADIUS] = [76, 27, 8];
const NAMES: readonly Axis[] = ["x", "y", "z"];

/** The model's axes in a corner of the stage. A press on an end looks from there. */
export class AxisWidget {
  readonly element = svg("svg", {
    class: "axis-widget",
    viewBox: `${-SIZE / 2} ${-SIZE / 2} ${SIZE} ${SIZE}`,
    role: "group",
    "aria-label": "Axes of the model",
  });
  readonly #stage: Stage;
  readonly #ends: { group: SVGElement; line: SVGElement | null; direction: Vector3 }[] = [];
  #seen = "";

  constructor(stage: Stage) {
    this.#stage = stage;
    NAMES.forEach((name, axis) => {
      for (const sign of [1, -1]) {
        const direction = new Vector3().setComponent(axis, sign);
        this.#ends.push(this.#end(name, AXIS_COLORS[axis], direction, sign > 0));
      }
    });
    this.update();
  }

  /** Turns with the camera; does nothing if it has not moved. */
  update(): void {
    const { camera, root } = this.#stage;
    const seen = [...camera.quaternion.toArray(), ...root.quaternion.toArray()].join();
    if (seen === this.#seen) return;
    this.#seen = seen;
    const toView = camera.quaternion.clone().invert().multiply(root.quaternion);
    const depths = this.#ends.map(({ group, line, direction }) => {
      const { x, y, z } = direction.clone().applyQuaternion(toView).multiplyScalar(REACH);
      group.setAttribute("transform", `translate(${x.toFixed(1)} ${(-y).toFixed(1)})`);
      line?.setAttribute("x2", x.toFixed(1));
      line?.setAttribute("y2", (-y).toFixed(1));
      return { z, parts: line ? [line, group] : [group] };
    });
    depths.sort((a, b) => a.z - b.z); // the nearest is painted last
    this.element.append(...depths.flatMap(({ parts }) => parts));
  }

  #end(name: Axis, color: string, direction: Vector3, isPositive: boolean) {
    const group = svg("g", {
      role: "button",
      tabindex: "0",
      "aria-label": `Look along ${isPositive ? "" : "minus "}${name}`,
    });
    group.append(
      svg("circle", {
        r: String(RADIUS),
        fill: color,
        "fill-opacity": isPositive ? "1" : "0.28",
        stroke: color,
      }),
    );
    if (isPositive) {
      const text = svg("text", { "text-anchor": "middle", dy: "3.5" });
      text.textContent = name.toUpperCase();
      group.append(text);
    }
    const look = () => this.#look(direction);
    group.addEventListener("click", look);
    group.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      event.stopPropagation();
      look();
    });
    const line = isPositive ? svg("line", { stroke: color, "stroke-width": "2.5" }) : null;
    return { group, line, direction };
  }

  #look(direction: Vector3): void {
    const from = direction.clone().applyQuaternion(this.#stage.root.getWorldQuaternion(new Quaternion()));
    // not quite vertical, so that the picture has an up
    if (Math.abs(from.y) > 0.999) from.z += 1e-3;
    this.#stage.look(1, from.normalize());
  }
}

function svg(tag: string, attributes: Record<string, string>): SVGElement {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}
