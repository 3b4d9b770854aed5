// Written by tools/make_messages.py from snapspace/server/messages.py.

export type Vector = readonly [number, number, number];
export type Matrix = readonly [number, number, number, number, number, number, number, number, number];

/** A handle that the page chose, or that a problem file has.
 *
 * name : unique among the handles
 * vertices : indices among all vertices of the packed mesh, also those inside
 * moving : whether it moves while sampling; at least one handle does not
 * translation, angle : its own bounds of the sampled motions; null: the common ones
 */
export interface HandleChoice {
  readonly name: string;
  readonly vertices: readonly number[];
  readonly moving?: boolean;
  readonly translation?: Vector | null;
  readonly angle?: Vector | null;
}

/** A part of the body that is stiffer or softer.
 *
 * name : unique among the parts
 * vertices : as for a handle; tets with at least three corners among them are in the part
 * factor : multiplies all moduli there, 0.0001 to 10000; where parts overlap, the later one counts
 */
export interface PartChoice {
  readonly name: string;
  readonly vertices: readonly number[];
  readonly factor: number;
}

/** A material that can be computed with.
 *
 * kind, title : its name in files and messages, and its name for the reader
 * has_poisson : whether Poisson's ratio changes anything
 */
export interface MaterialChoice {
  readonly kind: string;
  readonly title: string;
  readonly has_poisson: boolean;
}

/** Where a handle is: a rigid motion about its centre at rest.
 *
 * rotation : matrix, row by row
 */
export interface HandleMotion {
  readonly rotation: Matrix;
  readonly translation: Vector;
}

/** Something about a surface that its user should know, see `doctor.Finding`. */
export interface SurfaceFinding {
  readonly name: string;
  readonly fault: boolean;
  readonly text: string;
  readonly meaning: string;
  readonly cure: string;
}

/** Page: choose these handles and parts. Answered by `Chosen`, or `Failed`.
 *
 * request : any 32-bit integer, repeated in the answers
 * translation, angle : common bounds of the sampled motions, half widths per axis
 * parts : stiffer and softer parts; the rest has the material's moduli
 */
export interface Choose {
  readonly type: "choose";
  readonly request: number;
  readonly handles: readonly HandleChoice[];
  readonly translation: Vector;
  readonly angle: Vector;
  readonly parts?: readonly PartChoice[];
}

/** Page: compute models for the handles chosen last. A running computation is replaced.
 *
 * Answered by `Progress` and `Model`, the last one `final`; or `Cancelled`, or `Failed`.
 *
 * target_error, most_samples, seed : as for `growing_models`; null: the usual number of samples
 * stiffness : stiffness of the handles, as in a problem file
 * material : kind of the material; null: that of the problem file, or the default one
 * poisson : Poisson's ratio, 0 to 0.49; null: that of the problem file, or that of lam = mu
 */
export interface Compute {
  readonly type: "compute";
  readonly request: number;
  readonly target_error: number;
  readonly most_samples?: number | null;
  readonly seed: number;
  readonly stiffness: number;
  readonly material?: string | null;
  readonly poisson?: number | null;
}

/** Page: stop filling or computing. Models and solved samples are kept.
 *
 * Answered by `Cancelled`, even if nothing is running.
 */
export interface Cancel {
  readonly type: "cancel";
  readonly request: number;
}

/** Page: save problem, newest model, and a mesh that is in no file yet. Answered by `Saved`.
 *
 * name : name of the files, without folder or extension; null: the mesh's
 * up : axis that points up; null: the server's; timeline : content of a timeline file
 */
export interface Save {
  readonly type: "save";
  readonly request: number;
  readonly name?: string | null;
  readonly up?: string | null;
  readonly timeline?: string | null;
}

/** Page: improve a shape in the full space. A running polish is replaced and not answered.
 *
 * Answered by a binary frame with `request` as a 32-bit integer and the positions of the surface's
 * vertices as 32-bit floats, all little endian, in the order of the packed model; then `Polished`.
 *
 * model : its number; iterations : the most that are taken
 * handles : for posing models, the motions of all handles, in the model's order
 * weights : for blending models, one per pose
 * q : coordinates of the shape, all or the leading ones
 */
export interface Polish {
  readonly type: "polish";
  readonly request: number;
  readonly model: number;
  readonly handles?: readonly HandleMotion[];
  readonly weights?: readonly number[];
  readonly q: readonly number[];
  readonly iterations?: number;
}

/** Page: keep the choices made so far, even if they cannot be computed yet. Not answered.
 *
 * The next `Workspace` of the same id returns them, for example after the page is reloaded.
 *
 * Fields as in `Choose`, handles in any order, and as in `Compute`; up : axis that points up.
 */
export interface Keep {
  readonly type: "keep";
  readonly request: number;
  readonly handles: readonly HandleChoice[];
  readonly parts: readonly PartChoice[];
  readonly translation: Vector;
  readonly angle: Vector;
  readonly target_error: number;
  readonly most_samples: number | null;
  readonly stiffness: number;
  readonly material: string;
  readonly poisson: number | null;
  readonly up: string;
}

/** Page: choose other handles on the body of the server's model. Answered by `Workspace`. */
export interface Edit {
  readonly type: "edit";
  readonly request: number;
}

/** Page: examine the surface that was filled. Answered by `Checked`, or `Failed`. */
export interface Check {
  readonly type: "check";
  readonly request: number;
}

/** Server: the workspace of the page. The first message, sent again after an upload.
 *
 * A page that reconnects gets its choices back; the newest `Model` and last `Progress` follow.
 *
 * id : part of the address of uploads, POST mesh?workspace=ID&name=FILE&token=..., and of the
 *     websocket of a page that reconnects, live?workspace=ID&token=...
 * kind : "empty": the page asks for a mesh; "reading": progress and another workspace follow;
 *     "mesh": handles can be chosen; "model": the page's own model, number 0, can be polished
 * name : name of the mesh or model
 * mesh : address of the packed mesh; null unless the kind is mesh
 * up : axis that points up at first, x, y or z
 * handles, parts, translation, angle : initial choices
 * diagonal : diagonal of the mesh; 0 if there is none
 * target_error, most_samples, seed, stiffness, material, poisson : initial values for `Compute`
 * materials : materials that can be chosen
 * folder : folder where `Save` writes, to show to the reader
 * upload_limit : largest upload, in bytes
 * own_poisson : Poisson's ratio that the page chose in place of `poisson`; null: none
 * job : request of the last `Compute` for this mesh; 0 if there was none
 * is_running : whether that is still running
 * has_surface : whether the mesh came as a surface, so that `Check` examines it
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
  readonly poisson: number | null;
  readonly folder: string;
  readonly upload_limit: number;
  readonly parts?: readonly PartChoice[];
  readonly most_samples?: number | null;
  readonly own_poisson?: number | null;
  readonly job?: number;
  readonly is_running?: boolean;
  readonly has_surface?: boolean;
}

/** Server: the handles are accepted, in this order; the first one holds the shape. */
export interface Chosen {
  readonly type: "chosen";
  readonly request: number;
  readonly handles: readonly string[];
}

/** Server: progress of the work, at most ten times a second.
 *
 * request : that of the `Compute`; 0 while a mesh is read or filled
 * stage : waiting (for another computation), reading, filling, filling inside, filling boundary,
 *     filling exactly, snapshots, subspace, energy
 * done, total : numbers of samples, points or steps; 0 of 0 where nothing is counted, and a number
 *     of 0 for passes of fTetWild, which do not know how many follow
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
 * number : increases from model to model; it is part of the address
 * address : address of the packed model, valid until there are two newer ones
 * dimension, samples : dimension and number of samples of this model
 * error : median relative error at motions not used for training; null if not known yet
 * seconds : time since the computation began
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
}

/** Server: nothing is running any more.
 *
 * request : that of the `Cancel`
 */
export interface Cancelled {
  readonly type: "cancelled";
  readonly request: number;
}

/** Server: a request was refused, or its work failed.
 *
 * request : 0 if the message could not be read, and for meshes
 * message : the fault and its cure, one line for the reader
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
 * mended : what was mended before the surface was filled, a sentence each
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

export type PageMessage = Choose | Compute | Cancel | Save | Polish | Keep | Edit | Check;

export type ServerMessage =
  Workspace | Chosen | Progress | Model | Cancelled | Failed | Saved | Polished | Checked;
