"""Messages from a page to its server; those to the page are in messages.py."""

from __future__ import annotations

from dataclasses import dataclass

from .message_parts import HandleChoice, HandleMotion, KeptPoint, PartChoice, Vector


@dataclass(frozen=True, kw_only=True)
class Choose:
    """Page: choose these handles and parts. Answered by `Chosen`, or `Failed`.

    request : any 32-bit integer, repeated in the answers
    translation, angle : common bounds of the sampled motions, half widths per axis
    parts : stiffer and softer parts; the rest has the material's moduli
    thickness : thickness of the shell that the surface becomes; null: the body as it was opened
    """

    request: int
    handles: tuple[HandleChoice, ...]
    translation: Vector
    angle: Vector
    parts: tuple[PartChoice, ...] = ()
    thickness: float | None = None


@dataclass(frozen=True, kw_only=True)
class Mirror:
    """Page: make the mirror image of a handle. Answered by `Mirrored`, or `Failed`.

    axis : x, y or z, the normal of the plane; null: the plane is searched for
    """

    request: int
    handle: HandleChoice
    axis: str | None = None


@dataclass(frozen=True, kw_only=True)
class Compute:
    """Page: compute models for the handles chosen last. A running computation is replaced.

    Answered by `Progress` and `Model`, the last one `final`; or `Cancelled`, or `Failed`.

    target_error, most_samples, seed : as for `growing_models`; null: the usual number of samples
    stiffness : stiffness of the handles, as in a problem file
    material : kind of the material; null: that of the problem file, or the default one
    poisson : Poisson's ratio, 0 to 0.49; null: that of the problem file, or that of lam = mu
    """

    request: int
    target_error: float
    most_samples: int | None = None
    seed: int
    stiffness: float
    material: str | None = None
    poisson: float | None = None


@dataclass(frozen=True, kw_only=True)
class Extend:
    """Page: compute models with points as further handles. A running computation is replaced.

    The first model is made from the newest one, or from the server's own. Answered like `Compute`,
    with its target, number of samples and seed.
    """

    request: int
    points: tuple[KeptPoint, ...]


@dataclass(frozen=True, kw_only=True)
class Cancel:
    """Page: stop filling or computing. Models and solved samples are kept.

    Answered by `Cancelled`, even if nothing is running.

    upload : stop only the reading of an upload that has not replaced anything yet
    """

    request: int
    upload: bool = False


@dataclass(frozen=True, kw_only=True)
class Save:
    """Page: save problem, newest model, and the mesh unless a file has it. Answered by `Saved`.

    name : name of the files, without folder or extension; null: the mesh's
    up : axis that points up; null: the server's; timeline : content of a timeline file
    """

    request: int
    name: str | None = None
    up: str | None = None
    timeline: str | None = None


@dataclass(frozen=True, kw_only=True)
class Export:
    """Page: make a page in one file with a model, as `Save` would store it. Answered by `Exported`.

    model : its number; up, timeline : as in `Save`
    """

    request: int
    model: int
    up: str | None = None
    timeline: str | None = None


@dataclass(frozen=True, kw_only=True)
class Keep:
    """Page: store the choices so far, even if they cannot be computed yet. Not answered.

    The next `Workspace` of the same id returns them, for example after the page is reloaded.

    Fields as in `Choose`, handles in any order, and as in `Compute`; up : axis that points up.
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
    thickness: float | None = None


@dataclass(frozen=True, kw_only=True)
class Reopen:
    """Page: fill the surface with tets, or make it a shell at once, even while it is being filled.

    Answered by `Reopened` and a `Workspace` with the choices of the last `Keep`, or by `Failed`. If
    filling fails or is cancelled, the body is as before, and another `Workspace` says so.

    thickness : thickness of the shell; null: fill the surface
    """

    request: int
    thickness: float | None = None


@dataclass(frozen=True, kw_only=True)
class Edit:
    """Page: choose other handles on the body of the server's model. Answered by `Workspace`."""

    request: int


@dataclass(frozen=True, kw_only=True)
class Check:
    """Page: examine the surface. Answered by `Checked`, or `Failed`."""

    request: int


@dataclass(frozen=True, kw_only=True)
class Polish:
    """Page: improve a shape in the full space. A running polish is replaced and not answered.

    Answered by a binary frame with `request` as a 32-bit integer and the positions of the surface's
    vertices as 32-bit floats, all little endian, in the order of the packed model; then `Polished`.

    model : its number; iterations : the largest number of iterations
    handles : for posing models, the motions of all handles, in the model's order
    weights : for blending models, one per pose
    q : coordinates of the shape, all or the leading ones
    """

    request: int
    model: int
    handles: tuple[HandleMotion, ...] = ()
    weights: tuple[float, ...] = ()
    q: tuple[float, ...]
    iterations: int = 10
