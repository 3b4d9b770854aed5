"""Messages between a page and its server; tools/make_messages.py writes them for TypeScript.

On the websocket a message is a JSON object: the fields of one of these classes, and `type`, the
class's name in snake case. Lengths are in the mesh's unit, angles in radians, times in seconds.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from .message_parts import (
    HandleChoice,
    HandleMotion,
    MaterialChoice,
    Matrix,
    PartChoice,
    Vector,
)

__all__ = ["HandleChoice", "HandleMotion", "MaterialChoice", "Matrix", "PartChoice", "Vector"]


@dataclass(frozen=True, kw_only=True)
class Choose:
    """Page: these are the handles and parts. Answered by `Chosen`, or `Failed`.

    request : any number of 32 bits, repeated in the answers
    translation, angle : common bounds of the sampled motions, half widths per axis
    parts : stiffer and softer ones; the rest is as the material says
    """

    request: int
    handles: tuple[HandleChoice, ...]
    translation: Vector
    angle: Vector
    parts: tuple[PartChoice, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Compute:
    """Page: compute models for the handles chosen last. A computation that runs is replaced.

    Answered by `Progress` and `Model`, the last one `final`; or `Cancelled`, or `Failed`.

    target_error, most_samples, seed : as for `growing_models`; null: as many samples as usual
    stiffness : of the handles, as in a problem file
    material : kind of the material; null: that of the problem file, or the default one
    poisson : Poisson's ratio, 0 to 0.49; null: that of the problem file, or of lam = mu
    """

    request: int
    target_error: float
    most_samples: int | None = None
    seed: int
    stiffness: float
    material: str | None = None
    poisson: float | None = None


@dataclass(frozen=True, kw_only=True)
class Cancel:
    """Page: end what runs, filling or computing. Models and solved samples stay.

    Answered by `Cancelled`, also if nothing runs.
    """

    request: int


@dataclass(frozen=True, kw_only=True)
class Save:
    """Page: save the problem, the newest model, and what is in no file yet. Answered by `Saved`.

    name : of the files, without folder or ending; null: the mesh's
    up : axis that points up, saved with problem and model; null: the server's
    """

    request: int
    name: str | None = None
    up: str | None = None


@dataclass(frozen=True, kw_only=True)
class Keep:
    """Page: what is chosen so far, also what cannot be computed yet. There is no answer.

    The next `Workspace` of the same id returns it, as after the page was loaded again.

    As in `Choose`, in any order, and as in `Compute`; and the axis that points up.
    """

    request: int
    handles: tuple[HandleChoice, ...]
    parts: tuple[PartChoice, ...]
    translation: Vector
    angle: Vector
    target_error: float
    most_samples: int | None
    stiffness: float
    material: str
    poisson: float | None
    up: str


@dataclass(frozen=True, kw_only=True)
class Edit:
    """Page: choose handles on the body of the server's own model. Answered by `Workspace`."""

    request: int


@dataclass(frozen=True, kw_only=True)
class Polish:
    """Page: improve a shape in the full space. A polish that runs is replaced, without an answer.

    Answered by a binary frame, `request` as a 32-bit integer and the positions of the surface's
    vertices as 32-bit floats, all little endian, in the order of the packed model; then `Polished`.

    model : number of the model
    handles : where the handles of the model are, all of them and in its order; of posing models
    weights : of blending models, one per pose
    q : coordinates of the shape, or fewer, the leading ones
    iterations : at most
    """

    request: int
    model: int
    handles: tuple[HandleMotion, ...] = ()
    weights: tuple[float, ...] = ()
    q: tuple[float, ...]
    iterations: int = 10


@dataclass(frozen=True, kw_only=True)
class Workspace:
    """Server: what the page works with. The first message, and again after an upload.

    A page that comes back gets what it had chosen; newest `Model` and last `Progress` follow.

    id : in the address of uploads, POST mesh?workspace=ID&name=FILE&token=..., and in that of the
        websocket, live?workspace=ID&token=..., of a page that comes back
    kind : "empty": the page asks for a mesh; "reading": progress follows, and another workspace;
        "mesh": handles can be chosen; "model": the page's own model, number 0, can be polished
    name : of the mesh or model
    mesh : address of the packed mesh; null unless the kind is mesh
    up : axis that points up at first, x, y or z
    handles, parts, translation, angle : chosen at first
    diagonal : of the mesh; 0 if there is none
    target_error, most_samples, seed, stiffness, material, poisson : computed with at first
    materials : that can be chosen
    folder : where `Save` writes, for the reader
    upload_limit : bytes
    own_poisson : Poisson's ratio that the page chose in place of `poisson`; null: none
    job : request of the last `Compute` for this mesh; 0 if there was none
    is_running : whether it still computes
    """

    id: str
    kind: str
    name: str
    mesh: str | None
    up: str
    handles: tuple[HandleChoice, ...]
    translation: Vector
    angle: Vector
    diagonal: float
    target_error: float
    seed: int
    stiffness: float
    materials: tuple[MaterialChoice, ...]
    material: str
    poisson: float | None
    folder: str
    upload_limit: int
    parts: tuple[PartChoice, ...] = ()
    most_samples: int | None = None
    own_poisson: float | None = None
    job: int = 0
    is_running: bool = False


@dataclass(frozen=True, kw_only=True)
class Chosen:
    """Server: the handles are taken, in this order, the one that holds the shape first."""

    request: int
    handles: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Progress:
    """Server: how far the work is; up to ten a second.

    request : of the `Compute`; 0 while a mesh is read or filled
    stage : waiting (for another computation), reading, filling, snapshots, subspace, energy
    done, total : samples; 0 of 0 where nothing is counted
    seconds : since the work began
    eta : until the stage ends; null if not known
    error : of the newest model, as there; null if not known yet
    """

    request: int
    stage: str
    done: int
    total: int
    seconds: float
    eta: float | None
    error: float | None


@dataclass(frozen=True, kw_only=True)
class Model:
    """Server: a model that can be posed. Better ones follow until one is final.

    number : increases; that of the newest model is in its address
    address : of the packed model; it stays until two newer ones are there
    dimension, samples : of this model
    error : relative error of motions that it is not made of, the median; null if not known yet
    seconds : since the computation began
    """

    request: int
    number: int
    address: str
    dimension: int
    samples: int
    error: float | None
    final: bool
    seconds: float


@dataclass(frozen=True, kw_only=True)
class Cancelled:
    """Server: nothing runs any more.

    request : of the `Cancel`
    """

    request: int


@dataclass(frozen=True, kw_only=True)
class Failed:
    """Server: a request was refused, or its work came to an error.

    request : 0 where the message could not be read, and for meshes
    message : what is wrong and what helps, one line for the reader
    """

    request: int
    message: str


@dataclass(frozen=True, kw_only=True)
class Saved:
    """Server: what was written.

    problem, model, mesh, surface : paths; null for what there is not
    """

    request: int
    problem: str | None
    model: str | None
    mesh: str | None
    surface: str | None


@dataclass(frozen=True, kw_only=True)
class Polished:
    """Server: the shape of the binary frame before this message.

    moved : root mean square over the body, relative to the displacement from rest; null without one
    status : converged, max_iterations, line_search_failed or not_finite
    """

    request: int
    moved: float | None
    iterations: int
    status: str
    seconds: float


FROM_PAGE = (Choose, Compute, Cancel, Save, Polish, Keep, Edit)
FROM_SERVER = (Workspace, Chosen, Progress, Model, Cancelled, Failed, Saved, Polished)
PARTS = (HandleChoice, PartChoice, MaterialChoice, HandleMotion)

PageMessage = Choose | Compute | Cancel | Save | Polish | Keep | Edit
ServerMessage = Workspace | Chosen | Progress | Model | Cancelled | Failed | Saved | Polished


def type_name(message: type) -> str:
    """The `type` of a message's class: its name in snake case."""
    return re.sub(r"(?<!^)(?=[A-Z])", "_", message.__name__).lower()
