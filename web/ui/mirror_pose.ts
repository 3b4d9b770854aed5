import { mirroredMotions } from "../engine/mirror.ts";
import { h, mark, setText } from "./dom.ts";
import type { Posing } from "./posing.ts";

const TITLE = "Swaps left and right; M";

/** The button that mirrors the pose, and a line that says why it cannot, once it was pressed. */
export function mirrorPose(posing: Posing) {
  const hint = h("p", { className: "hint", role: "status" });
  const act = () => {
    const { mirror } = posing.session.model;
    if ("refused" in mirror) return void setText(hint, mirror.refused);
    if (!posing.isDragging) posing.edit(mirroredMotions(posing.motions, mirror).entries());
  };
  const button = h("button", { type: "button", id: "mirror-pose", onclick: act }, "Mirror pose");
  /** Shows whether the model can be mirrored. It can still be pressed, so that keys reach the reason too. */
  const update = () => {
    const { mirror } = posing.session.model;
    const refused = "refused" in mirror ? mirror.refused : "";
    button.title = refused || TITLE;
    const isNew = mark(button, "aria-disabled", refused !== "");
    if (refused === "") setText(hint, "");
    return isNew;
  };
  update();
  return { button, hint, update };
}
