// Written by tools/make_messages.py from snapspace/server/messages.py.

import type { Vector, HandleChoice, PartChoice, MaterialChoice, SurfaceFinding } from "./page_messages.ts";

export type * from "./page_messages.ts";

/** Server: the workspace of the page. The first message, sent again after an upload.
 *
 * A page that reconnects gets its choices back; the newest `Model` and last `Progress` follow.
 *
 * id : part of the address of uploads, POST mesh?workspace=ID&name=FILE&request=N&token=..., and
 *     of the websocket of a page that reconnects, live?workspace=ID&token=...
 * kind : "empty": the page asks for a mesh; "reading": progress and another workspace follow;
 *     "surface": the surface can only be viewed yet, and progress of filling it and a workspace of
 *     its tets, or `Failed`, follow; "mesh": handles can be chosen; "model": the page's own model,
 *     number 0, can be polished
 * name : name of the mesh or model
 * mesh : address of the packed mesh, the same while it is filled and afterwards; null unless the
 *     kind is surface or mesh
 * up : axis that points up at first, x, y or z
 * handles, parts, translation, angle : initial choices
 * diagonal : diagonal of the mesh; 0 if there is none
 * target_error, most_samples, seed, stiffness, material, poisson : initial values for `Compute`
 * materials : materials that can be chosen
 * solid_material, shell_material : kinds of the initial materials of a solid and of a shell
 * folder : folder where `Save` writes, to show to the reader
 * upload_limit : largest upload, in bytes
 * own_poisson : Poisson's ratio that the page chose instead of `poisson`; null: none
 * job : request of the last `Compute` or `Extend` for this mesh; 0 if there was none
 * is_running : whether that request is still running
 * has_model : whether a model of that request follows
 * has_surface : whether the mesh came as a surface, so that `Check` examines it
 * thickness : thickness of the shell; null: a solid
 * usual_thickness : initial thickness if a solid becomes a shell; null: it came as tets
 * is_filled : whether there are tets instead of only a surface
 * is_open : whether the surface is a shell with holes, which filling would close
 * notices : what was mended or left out when the mesh was made, or is not shown, one sentence each
 */
export interface Workspace {
  readonly type: "workspace";
  readonly id: string;
  readonly kind: string;
  readonly name: string;
  readonly mesh: string | null;
  readonly up: string;
  readonly handles: readonly HandleChoice[];
  readonly translation: Vector;
  readonly angle: Vector;
  readonly diagonal: number;
  readonly target_error: number;
  readonly seed: number;
  readonly stiffness: number;
  readonly materials: readonly MaterialChoice[];
  readonly material: string;
  readonly solid_material: string;
  readonly shell_material: string;
  readonly poisson: number | null;
  readonly folder: string;
  readonly upload_limit: number;
  readonly parts?: readonly PartChoice[];
  readonly most_samples?: number | null;
  readonly own_poisson?: number | null;
  readonly job?: number;
  readonly is_running?: boolean;
  readonly has_model?: boolean;
  readonly has_surface?: boolean;
  readonly thickness?: number | null;
  readonly usual_thickness?: number | null;
  readonly is_filled?: boolean;
  readonly is_open?: boolean;
  readonly notices?: readonly string[];
}

/** Server: the handles are accepted, in this order; the first one holds the shape. */
export interface Chosen {
  readonly type: "chosen";
  readonly request: number;
  readonly handles: readonly string[];
}

/** Server: the mirror image of a handle, and the mirror plane.
 *
 * normal, point : unit normal of the plane, and a point on it
 * deviation : deviation of the surface from its mirror image, relative to the diagonal; null if
 *     not known
 */
export interface Mirrored {
  readonly type: "mirrored";
  readonly request: number;
  readonly handle: HandleChoice;
  readonly normal: Vector;
  readonly point: Vector;
  readonly deviation: number | null;
}

/** Server: progress of the work, at most ten times a second.
 *
 * request : that of the `Compute` or `Extend`; 0 while a mesh is read or filled
 * stage : waiting (for another computation), reading, filling, filling inside, filling boundary,
 *     filling exactly, snapshots, subspace, energy
 * done, total : numbers of samples, points or steps; 0 of 0 if nothing is counted, and a number of
 *     0 for passes of fTetWild, whose total is not known
 * seconds : time since the work began
 * eta : expected time until the stage ends; null if not known
 * error : `error` of the newest model; null if not known yet
 */
export interface Progress {
  readonly type: "progress";
  readonly request: number;
  readonly stage: string;
  readonly done: number;
  readonly total: number;
  readonly seconds: number;
  readonly eta: number | null;
  readonly error: number | null;
}

/** Server: a model that can be posed. Better ones follow until one is final.
 *
 * After the `Workspace` of a model's body, that model is sent, final and with request 0: it can be
 * posed or blended until another one is computed.
 *
 * number : increases from model to model; it is part of the address
 * address : address of the packed model, valid until there are two newer ones
 * dimension, samples : dimension of this model, and number of samples that made or judged it, with
 *     those of the model it started from
 * error : median relative error at motions not used for training; null if not known yet
 * seconds : time since the computation began
 * kept : the points of an `Extend` message, which are handles of this model
 */
export interface Model {
  readonly type: "model";
  readonly request: number;
  readonly number: number;
  readonly address: string;
  readonly dimension: number;
  readonly samples: number;
  readonly error: number | null;
  readonly final: boolean;
  readonly seconds: number;
  readonly kept?: readonly HandleChoice[];
}

/** Server: nothing is running any more.
 *
 * request : that of the `Cancel`
 */
export interface Cancelled {
  readonly type: "cancelled";
  readonly request: number;
}

/** Server: the surface is opened again; a `Workspace` follows.
 *
 * request : that of the `Reopen`
 */
export interface Reopened {
  readonly type: "reopened";
  readonly request: number;
}

/** Server: a request was refused, or its work failed.
 *
 * request : 0 if the message could not be read, and for meshes
 * message : the fault and its cure, in one line for the reader
 */
export interface Failed {
  readonly type: "failed";
  readonly request: number;
  readonly message: string;
}

/** Server: the files that were written.
 *
 * problem, model, mesh, surface : paths; null where nothing was written
 */
export interface Saved {
  readonly type: "saved";
  readonly request: number;
  readonly problem: string | null;
  readonly model: string | null;
  readonly mesh: string | null;
  readonly surface: string | null;
}

/** Server: the page in one file is ready.
 *
 * address : its address, valid until the next `Exported`
 */
export interface Exported {
  readonly type: "exported";
  readonly request: number;
  readonly address: string;
}

/** Server: a report on the shape in the preceding binary frame.
 *
 * moved : root mean square over the body, relative to the displacement from rest; null if at rest
 * status : converged, max_iterations, line_search_failed or not_finite
 */
export interface Polished {
  readonly type: "polished";
  readonly request: number;
  readonly moved: number | null;
  readonly iterations: number;
  readonly status: string;
  readonly seconds: number;
}

/** Server: what is wrong with the surface.
 *
 * fine : whether nothing needed mending
 * findings : faults first
 * mended : what was mended before the surface was filled, one sentence each
 * invented : positions of the corners of faces that close holes, nine numbers per face
 */
export interface Checked {
  readonly type: "checked";
  readonly request: number;
  readonly fine: boolean;
  readonly findings: readonly SurfaceFinding[];
  readonly mended: readonly string[];
  readonly invented: readonly number[];
}

export type ServerMessage =
  | Workspace
  | Chosen
  | Mirrored
  | Progress
  | Model
  | Cancelled
  | Reopened
  | Failed
  | Saved
  | Exported
  | Polished
  | Checked;
