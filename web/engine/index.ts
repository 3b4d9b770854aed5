export { BlendingSession } from "./blending_session.ts";
export type { FrameReport } from "./core.ts";
export { UnreadableModel } from "./errors.ts";
export type { BlendingModel, Model, PosingModel } from "./model.ts";
export { PosingSession, type Motion } from "./posing_session.ts";
export { rotationOfEuler } from "./motion.ts";
export { readModel } from "./read_model.ts";
export { reconstruct, type ShapeSpace } from "./shape_space.ts";
