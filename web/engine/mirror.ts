import type { Vector } from "./motion.ts";
import { product } from "./motion.ts";
import type { Motion } from "./posing_session.ts";

/** How poses are mirrored, found by the server or the export (snapspace/page/mirror.py). */
export interface Mirror {
  /** Unit vector across the plane. */
  readonly normal: Vector;
  /** For each handle the one at its mirror image, perhaps itself. */
  readonly counterparts: readonly number[];
}

/** Why poses cannot be mirrored, for the reader. */
export interface NoMirror {
  readonly refused: string;
}

const NOT_KNOWN = "This model does not say which handles are counterparts.";

/** The reason for model files, which do not say how poses are mirrored. */
export const NO_MIRROR: NoMirror = {
  refused: `${NOT_KNOWN} Open it with snapspace view, or export it as a page.`,
};

/** Reads what an exported page says. */
export function readMirror(about: unknown, handles: number): Mirror | NoMirror {
  const given = Object(about) as Record<string, unknown>;
  if (typeof given["refused"] === "string") return { refused: given["refused"] };
  const { normal, counterparts } = given;
  const isWhole =
    Array.isArray(normal) &&
    normal.length === 3 &&
    Math.abs(Math.hypot(...normal) - 1) < 1e-6 &&
    Array.isArray(counterparts) &&
    counterparts.length === handles &&
    counterparts.every((other, own) => counterparts[other] === own);
  if (!isWhole) return { refused: `${NOT_KNOWN} Export the page again.` };
  return { normal: normal as unknown as Vector, counterparts };
}

/** The motions of all handles with the sides swapped and mirrored: rotations H R H and translations H t for
 * H = I - 2 n n^T. */
export function mirroredMotions(motions: readonly Motion[], { normal, counterparts }: Mirror): Motion[] {
  const H = normal.flatMap((a, row) => normal.map((b, column) => (row === column ? 1 : 0) - 2 * a * b));
  return counterparts.map((other) => {
    const { rotation, translation } = motions[other];
    const along = normal.reduce((sum, n, axis) => sum + n * translation[axis], 0);
    const [x, y, z] = normal.map((n, axis) => translation[axis] - 2 * along * n);
    return { rotation: product(product(H, rotation), H), translation: [x, y, z] };
  });
}
