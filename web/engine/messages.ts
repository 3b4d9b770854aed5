// Written by tools/make_messages.py from snapspace/server/messages.py.

export type Vector = readonly [number, number, number];
export type Matrix = readonly [number, number, number, number, number, number, number, number, number];

/** A handle as the page chose it, or as a problem file has it.
 *
 * name : unique among the handles
 * vertices : indices among all vertices of the packed mesh, also those inside
 * moving : whether it moves while sampling; one handle at least does not
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
 * vertices : as those of a handle; tets with three of their corners among them are in the part
 * factor : of all moduli there, 0.0001 to 10000; of parts that overlap the later one counts
 */
export interface PartChoice {
  readonly name: string;
  readonly vertices: readonly number[];
  readonly factor: number;
}

/** A material that can be computed with.
 *
 * kind, title : its name in files and messages, and for the reader
 * has_poisson : whether Poisson's ratio changes anything
 */
export interface MaterialChoice {
  readonly kind: string;
  readonly title: string;
  readonly has_poisson: boolean;
}

/** Where a handle is: a rigid motion about its centre at rest.
 *
 * rotation : row by row
 */
export interface HandleMotion {
  readonly rotation: Matrix;
  readonly translation: Vector;
}

/** Page: these are the handles and parts. Answered by `Chosen`, or `Failed`.
 *
 * request : any number of 32 bits, repeated in the answers
 * translation, angle : common bounds of the sampled motions, half widths per axis
 * parts : stiffer and softer ones; the rest is as the material says
 */
export interface Choose {
  readonly type: "choose";
  readonly request: number;
  readonly handles: readonly HandleChoice[];
  readonly translation: Vector;
  readonly angle: Vector;
  readonly parts?: readonly PartChoice[];
}

/** Page: compute models for the handles chosen last. A computation that runs is replaced.
 *
 * Answered by `Progress` and `Model`, the last one `final`; or `Cancelled`, or `Failed`.
 *
 * target_error, most_samples, seed : as for `growing_models`; null: as many samples as usual
 * stiffness : of the handles, as in a problem file
 * material : kind of the material; null: that of the problem file, or the default one
 * poisson : Poisson's ratio, 0 to 0.49; null: that of the problem file, or of lam = mu
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

/** Page: end what runs, filling or computing. Models and solved samples stay.
 *
 * Answered by `Cancelled`, also if nothing runs.
 */
export interface Cancel {
  readonly type: "cancel";
  readonly request: number;
}

/** Page: save the problem, the newest model, and what is in no file yet. Answered by `Saved`.
 *
 * name : of the files, without folder or ending; null: the mesh's
 * up : axis that points up, saved with problem and model; null: the server's
 */
export interface Save {
  readonly type: "save";
  readonly request: number;
  readonly name?: string | null;
  readonly up?: string | null;
}

/** Page: improve a shape in the full space. A polish that runs is replaced, without an answer.
 *
 * Answered by a binary frame, `request` as a 32-bit integer and the positions of the surface's
 * vertices as 32-bit floats, all little endian, in the order of the packed model; then `Polished`.
 *
 * model : number of the model
 * handles : where the handles of the model are, all of them and in its order; of posing models
 * weights : of blending models, one per pose
 * q : coordinates of the shape, or fewer, the leading ones
 * iterations : at most
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

/** Page: what is chosen so far, also what cannot be computed yet. There is no answer.
 *
 * The next `Workspace` of the same id returns it, as after the page was loaded again.
 *
 * As in `Choose`, in any order, and as in `Compute`; and the axis that points up.
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

/** Page: choose handles on the body of the server's own model. Answered by `Workspace`. */
export interface Edit {
  readonly type: "edit";
  readonly request: number;
}

/** Server: what the page works with. The first message, and again after an upload.
 *
 * A page that comes back gets what it had chosen; newest `Model` and last `Progress` follow.
 *
 * id : in the address of uploads, POST mesh?workspace=ID&name=FILE&token=..., and in that of the
 *     websocket, live?workspace=ID&token=..., of a page that comes back
 * kind : "empty": the page asks for a mesh; "reading": progress follows, and another workspace;
 *     "mesh": handles can be chosen; "model": the page's own model, number 0, can be polished
 * name : of the mesh or model
 * mesh : address of the packed mesh; null unless the kind is mesh
 * up : axis that points up at first, x, y or z
 * handles, parts, translation, angle : chosen at first
 * diagonal : of the mesh; 0 if there is none
 * target_error, most_samples, seed, stiffness, material, poisson : computed with at first
 * materials : that can be chosen
 * folder : where `Save` writes, for the reader
 * upload_limit : bytes
 * own_poisson : Poisson's ratio that the page chose in place of `poisson`; null: none
 * job : request of the last `Compute` for this mesh; 0 if there was none
 * is_running : whether it still computes
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
}

/** Server: the handles are taken, in this order, the one that holds the shape first. */
export interface Chosen {
  readonly type: "chosen";
  readonly request: number;
  readonly handles: readonly string[];
}

/** Server: how far the work is; up to ten a second.
 *
 * request : of the `Compute`; 0 while a mesh is read or filled
 * stage : waiting (for another computation), reading, filling, snapshots, subspace, energy
 * done, total : samples; 0 of 0 where nothing is counted
 * seconds : since the work began
 * eta : until the stage ends; null if not known
 * error : of the newest model, as there; null if not known yet
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
 * number : increases; that of the newest model is in its address
 * address : of the packed model; it stays until two newer ones are there
 * dimension, samples : of this model
 * error : relative error of motions that it is not made of, the median; null if not known yet
 * seconds : since the computation began
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

/** Server: nothing runs any more.
 *
 * request : of the `Cancel`
 */
export interface Cancelled {
  readonly type: "cancelled";
  readonly request: number;
}

/** Server: a request was refused, or its work came to an error.
 *
 * request : 0 where the message could not be read, and for meshes
 * message : what is wrong and what helps, one line for the reader
 */
export interface Failed {
  readonly type: "failed";
  readonly request: number;
  readonly message: string;
}

/** Server: what was written.
 *
 * problem, model, mesh, surface : paths; null for what there is not
 */
export interface Saved {
  readonly type: "saved";
  readonly request: number;
  readonly problem: string | null;
  readonly model: string | null;
  readonly mesh: string | null;
  readonly surface: string | null;
}

/** Server: the shape of the binary frame before this message.
 *
 * moved : root mean square over the body, relative to the displacement from rest; null without one
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

export type PageMessage = Choose | Compute | Cancel | Save | Polish | Keep | Edit;

export type ServerMessage = Workspace | Chosen | Progress | Model | Cancelled | Failed | Saved | Polished;
