import {
  eulerOfRotation,
  rotationOfEuler,
  type FrameReport,
  type Motion,
  type PosingSession,
} from "../engine/index.ts";

/** Moves from rest to motions of all handles in steps, as a drag does: one large step may end in another minimum. */
export function approach(session: PosingSession, motions: readonly Motion[]): FrameReport {
  let report = session.solve();
  for (const share of [0.25, 0.5, 0.75, 1])
    report = session.moveAll(new Map(motions.map((motion, handle) => [handle, partOf(motion, share)])));
  return report;
}

/** Whether all handles have the same motions in two states. */
export function areSame(a: readonly Motion[], b: readonly Motion[]): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

function partOf(motion: Motion, share: number): Motion {
  if (share === 1) return motion;
  const [a, b, c] = eulerOfRotation(motion.rotation);
  const [x, y, z] = motion.translation;
  return {
    rotation: rotationOfEuler([share * a, share * b, share * c]),
    translation: [share * x, share * y, share * z],
  };
}
