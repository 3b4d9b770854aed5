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
    KeptPoint,
    MaterialChoice,
    Matrix,
    PartChoice,
    SurfaceFinding,
    Vector,
)
from .page_messages import (
    Cancel,
    Check,
    Choose,
    Compute,
    Edit,
    Export,
    Extend,
    Keep,
    Mirror,
    Polish,
    Reopen,
    Save,
)
from .workspace_message import Workspace

__all__ = [
    "Cancel",
    "Check",
    "Choose",
    "Compute",
    "Edit",
    "Export",
    "Extend",
    "HandleChoice",
    "HandleMotion",
    "Keep",
    "KeptPoint",
    "MaterialChoice",
    "Matrix",
    "Mirror",
    "PartChoice",
    "Polish",
    "Reopen",
    "Save",
    "SurfaceFinding",
    "Vector",
    "Workspace",
]


@dataclass(frozen=True, kw_only=True)
class Chosen:
    """Server: the handles are accepted, in this order; the first one holds the shape."""

    request: int
    handles: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Mirrored:
    """Server: the mirror image of a handle, and the mirror plane.

    normal, point : unit normal of the plane, and a point on it
    deviation : deviation of the surface from its mirror image, relative to the diagonal; null if
        not known
    """

    request: int
    handle: HandleChoice
    normal: Vector
    point: Vector
    deviation: float | None


@dataclass(frozen=True, kw_only=True)
class Progress:
    """Server: progress of the work, at most ten times a second.

    request : that of the `Compute` or `Extend`; 0 while a mesh is read or filled
    stage : waiting (for another computation), reading, filling, filling inside, filling boundary,
        filling exactly, snapshots, subspace, energy
    done, total : numbers of samples, points or steps; 0 of 0 if nothing is counted, and a number of
        0 for passes of fTetWild, whose total is not known
    seconds : time since the work began
    eta : expected time until the stage ends; null if not known
    error : `error` of the newest model; null if not known yet
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

    After the `Workspace` of a model's body, that model is sent, final and with request 0: it can be
    posed or blended until another one is computed.

    number : increases from model to model; it is part of the address
    address : address of the packed model, valid until there are two newer ones
    dimension, samples : dimension of this model, and number of samples that made or judged it, with
        those of the model it started from
    error : median relative error at motions not used for training; null if not known yet
    seconds : time since the computation began
    kept : the points of an `Extend` message, which are handles of this model
    """

    request: int
    number: int
    address: str
    dimension: int
    samples: int
    error: float | None
    final: bool
    seconds: float
    kept: tuple[HandleChoice, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Cancelled:
    """Server: nothing is running any more.

    request : that of the `Cancel`
    """

    request: int


@dataclass(frozen=True, kw_only=True)
class Reopened:
    """Server: the surface is opened again; a `Workspace` follows.

    request : that of the `Reopen`
    """

    request: int


@dataclass(frozen=True, kw_only=True)
class Failed:
    """Server: a request was refused, or its work failed.

    request : 0 if the message could not be read, and for meshes
    message : the fault and its cure, in one line for the reader
    """

    request: int
    message: str


@dataclass(frozen=True, kw_only=True)
class Saved:
    """Server: the files that were written.

    problem, model, mesh, surface : paths; null where nothing was written
    """

    request: int
    problem: str | None
    model: str | None
    mesh: str | None
    surface: str | None


@dataclass(frozen=True, kw_only=True)
class Exported:
    """Server: the page in one file is ready.

    address : its address, valid until the next `Exported`
    """

    request: int
    address: str


@dataclass(frozen=True, kw_only=True)
class Checked:
    """Server: what is wrong with the surface.

    fine : whether nothing needed mending
    findings : faults first
    mended : what was mended before the surface was filled, one sentence each
    invented : positions of the corners of faces that close holes, nine numbers per face
    """

    request: int
    fine: bool
    findings: tuple[SurfaceFinding, ...]
    mended: tuple[str, ...]
    invented: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Polished:
    """Server: a report on the shape in the preceding binary frame.

    moved : root mean square over the body, relative to the displacement from rest; null if at rest
    status : converged, max_iterations, line_search_failed or not_finite
    """

    request: int
    moved: float | None
    iterations: int
    status: str
    seconds: float


FROM_PAGE = (
    Choose,
    Compute,
    Cancel,
    Save,
    Polish,
    Keep,
    Edit,
    Check,
    Mirror,
    Extend,
    Export,
    Reopen,
)
FROM_SERVER = (
    Workspace,
    Chosen,
    Mirrored,
    Progress,
    Model,
    Cancelled,
    Reopened,
    Failed,
    Saved,
    Exported,
    Polished,
    Checked,
)
PARTS = (HandleChoice, PartChoice, MaterialChoice, HandleMotion, KeptPoint, SurfaceFinding)

PageMessage = (
    Choose
    | Compute
    | Cancel
    | Save
    | Polish
    | Keep
    | Edit
    | Check
    | Mirror
    | Extend
    | Export
    | Reopen
)
ServerMessage = (
    Workspace
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
    | Checked
)


def type_name(message: type) -> str:
    """The `type` of a message's class: its name in snake case."""
    return re.sub(r"(?<!^)(?=[A-Z])", "_", message.__name__).lower()
