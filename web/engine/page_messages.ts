// Written by tools/make_messages.py from snapspace/server/messages.py.

export type Vector = readonly [number, number, number];
export type Matrix = readonly [number, number, number, number, number, number, number, number, number];

/** A handle that the page chose, or that a problem file has.
 *
 * name : unique among the handles
 * vertices : indices among all vertices of the packed mesh, including interior ones
 * moving : whether it moves while sampling; at least one handle must not
 * translation, angle : its own bounds of the sampled motions; null: the common bounds
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
 * factor : multiplies all moduli there, 0.0001 to 10000; where parts overlap, the last one counts
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
 * makes_shells : whether shells can be made of it
 */
export interface MaterialChoice {
  readonly kind: string;
  readonly title: string;
  readonly has_poisson: boolean;
  readonly makes_shells: boolean;
}

/** The motion of a handle: a rigid motion about its centre at rest.
 *
 * rotation : matrix, row by row
 */
export interface HandleMotion {
  readonly rotation: Matrix;
  readonly translation: Vector;
}

/** A point of the surface that the page has pulled and keeps.
 *
 * name : unique among the handles
 * corners, shares : three vertices of the surface in the packed model, and their barycentric
 *     weights
 * reach : displacement from rest to where it was pulled, per axis, in the frame of the first
 *     handle
 */
export interface KeptPoint {
  readonly name: string;
  readonly corners: readonly number[];
  readonly shares: Vector;
  readonly reach: Vector;
}

/** A property of a surface that its user should know, see `doctor.Finding`. */
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
 * thickness : thickness of the shell that the surface becomes; null: the body as it was opened
 */
export interface Choose {
  readonly type: "choose";
  readonly request: number;
  readonly handles: readonly HandleChoice[];
  readonly translation: Vector;
  readonly angle: Vector;
  readonly parts?: readonly PartChoice[];
  readonly thickness?: number | null;
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
 *
 * upload : stop only the reading of an upload that has not replaced anything yet
 */
export interface Cancel {
  readonly type: "cancel";
  readonly request: number;
  readonly upload?: boolean;
}

/** Page: save problem, newest model, and the mesh unless a file has it. Answered by `Saved`.
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
 * model : its number; iterations : the largest number of iterations
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

/** Page: store the choices so far, even if they cannot be computed yet. Not answered.
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
  readonly thickness?: number | null;
}

/** Page: choose other handles on the body of the server's model. Answered by `Workspace`. */
export interface Edit {
  readonly type: "edit";
  readonly request: number;
}

/** Page: examine the surface. Answered by `Checked`, or `Failed`. */
export interface Check {
  readonly type: "check";
  readonly request: number;
}

/** Page: make the mirror image of a handle. Answered by `Mirrored`, or `Failed`.
 *
 * axis : x, y or z, the normal of the plane; null: the plane is searched for
 */
export interface Mirror {
  readonly type: "mirror";
  readonly request: number;
  readonly handle: HandleChoice;
  readonly axis?: string | null;
}

/** Page: compute models with points as further handles. A running computation is replaced.
 *
 * The first model is made from the newest one, or from the server's own. Answered like `Compute`,
 * with its target, number of samples and seed.
 */
export interface Extend {
  readonly type: "extend";
  readonly request: number;
  readonly points: readonly KeptPoint[];
}

/** Page: make a page in one file with a model, as `Save` would store it. Answered by `Exported`.
 *
 * model : its number; up, timeline : as in `Save`
 */
export interface Export {
  readonly type: "export";
  readonly request: number;
  readonly model: number;
  readonly up?: string | null;
  readonly timeline?: string | null;
}

/** Page: fill the surface with tets, or make it a shell at once, even while it is being filled.
 *
 * Answered by `Reopened` and a `Workspace` with the choices of the last `Keep`, or by `Failed`. If
 * filling fails or is cancelled, the body is as before, and another `Workspace` says so.
 *
 * thickness : thickness of the shell; null: fill the surface
 */
export interface Reopen {
  readonly type: "reopen";
  readonly request: number;
  readonly thickness?: number | null;
}

export type PageMessage =
  Choose | Compute | Cancel | Save | Polish | Keep | Edit | Check | Mirror | Extend | Export | Reopen;
