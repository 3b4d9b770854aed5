"""Body: the mesh on which a page chooses handles."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..material import Material
from ..mesh import Body as Mesh
from ..mesh import EmbeddedSurface, MirrorPlane
from ..model_file.appearance import appearance_notes
from ..notice import collected_notices
from ..problem import PosingProblem
from ..reduction import ReducedModel


@dataclass(frozen=True, kw_only=True)
class Body:
    """A mesh, with its files and its problem, if it has one.

    name : name that is shown and given to files
    mesh : TetMesh, or ShellMesh of the surface
    file : Path of the tets, or None if no file of the user has them
    folder : Path of the folder where files are saved
    problem : PosingProblem with the initial handles, or None
    surface : EmbeddedSurface that was filled, shown instead of the tets' surface; or None
    surface_file : Path of the surface, or None if no file of the user has it
    up : axis that points up, or None if no file says so and the body has no surface file
    mirror : MirrorPlane that a file gives, or None
    painted : by the name of a handle, the vertices of the surface where it was painted
    material : initial Material, or None for the usual one
    notices : what was mended or left out when the mesh was made, or is not shown, for the reader
    model : ReducedModel that the body came from, or None
    """

    name: str
    mesh: Mesh
    file: Path | None
    folder: Path
    problem: PosingProblem | None = None
    surface: EmbeddedSurface | None = None
    surface_file: Path | None = None
    up: str | None = None
    mirror: MirrorPlane | None = None
    painted: Mapping[str, Sequence[int]] = field(default_factory=dict)
    material: Material | None = None
    notices: tuple[str, ...] = ()
    model: ReducedModel | None = None


def with_notices(
    make: Callable[[], Body], *, folder: Path | None = None, earlier: Sequence[str] = ()
) -> Body:
    """The body that `make` makes, with the notices given meanwhile, each once, without folders.

    The `earlier` notices come first.

    Notices may repeat, since fTetWild mends the surface again if quick tets fail. One more notice
    says what is not shown of the surface's own materials.
    """
    with collected_notices() as notices:
        body = make()
    if body.surface is not None and body.surface.source is not None:
        notices += appearance_notes(body.surface.source)
    place = "" if folder is None else f"{folder}{os.sep}"
    texts = (text.removeprefix(place) for text in (*earlier, *notices))
    return replace(body, notices=tuple(dict.fromkeys(texts)))
