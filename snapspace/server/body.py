"""Body: the mesh on which a page chooses handles."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..filling import SurfaceFilling
from ..input_error import located
from ..mesh import (
    SURFACE_SUFFIXES,
    TET_SUFFIXES,
    EmbeddedSurface,
    MirrorPlane,
    SurfaceFile,
    TetMesh,
    embed_file,
    open_surface,
    read_tets,
    shell_of_file,
)
from ..mesh import Body as Mesh
from ..mesh.embed_surface import WHOLE_DIAGONAL
from ..mesh.input_path import existing_file
from ..mesh.validation import check_points
from ..page.painted import painted_vertices
from ..problem import (
    PosingProblem,
    problem_surface_file,
    problem_thickness,
    read_problem,
    read_problem_surface,
)
from ..reduction import InterpolationModel, PosingModel, ReducedModel
from ..stopping import check_stop

PROBLEM_SUFFIX = ".json"
MESH_SUFFIXES = (*TET_SUFFIXES, *SURFACE_SUFFIXES)


@dataclass(frozen=True, kw_only=True)
class Body:
    """A mesh, with its files and, where there is one, its problem.

    name : name that is shown and given to files
    mesh : TetMesh, or ShellMesh of the surface
    file : Path of the tets, or None if no file of the user has them
    folder : Path of the folder where files are saved
    problem : PosingProblem with the initial handles, or None
    surface : EmbeddedSurface that was filled, shown in place of the tets' surface; or None
    surface_file : Path of the surface, or None if no file of the user has it
    up : axis that points up, or None if no file says it and it is no surface
    mirror : MirrorPlane that a file gives, or None
    painted : by the name of a handle, the vertices of the surface where it was painted
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


def problem_body(path: Path, *, filling: SurfaceFilling | None = None) -> Body:
    """Mesh, handles and surface of a problem file; ValueError if one of them cannot be read.

    A surface without tets is filled, if it is not a shell.
    """
    own = problem_surface_file(path)
    if own is None or problem_thickness(path) is not None:
        problem = read_problem(path)
        surface = read_problem_surface(path, problem.mesh)
    else:
        mesh, surface = _filled(own, stage=lambda *_: None, filling=filling)
        problem = read_problem(path, mesh=mesh)
    files = json.loads(path.read_text(encoding="utf-8"))
    return Body(
        name=path.stem,
        mesh=problem.mesh,
        file=None if own is not None else (path.parent / files["mesh"]).resolve(),
        folder=path.resolve().parent,
        problem=problem,
        surface=surface,
        surface_file=None if surface is None else (path.parent / files["surface"]).resolve(),
        up=files.get("up") or _up(surface),
        mirror=MirrorPlane(**files["mirror"]) if "mirror" in files else None,
        painted={
            name: handle["painted"]
            for name, handle in zip(problem.handles.names, files["handles"], strict=True)
            if "painted" in handle
        },
    )


def mesh_body(
    path: Path,
    *,
    stage: Callable[..., None],
    filling: SurfaceFilling | None = None,
    thickness: float | None = None,
    read: Callable[[SurfaceFile], None] = lambda _: None,
) -> Body:
    """Tets from a file, or made inside the surface in a file, or that surface as a shell.

    Parameters
    ----------
    path : Path
    stage : callable
        Called with "reading" before the file is read and, for a surface, with the stages of
        `SurfaceFilling.fill`.
    filling : SurfaceFilling, default quick tets
        How to fill a surface.
    thickness : float, optional
        Of the shell that a surface becomes; None fills it.
    read : callable, optional
        Called with a surface that has been read, before it is filled.

    Raises
    ------
    ValueError
        If the file cannot be read or filled, or is no surface of a shell; the message begins with
        its path.
    """
    existing_file(path, known=MESH_SUFFIXES)
    folder = path.resolve().parent
    stage("reading")
    if path.suffix.lower() in TET_SUFFIXES:
        if thickness is not None:
            raise ValueError(f"{path}: a shell is made of a surface, not of tets")
        return Body(name=path.stem, mesh=read_tets(path), file=path.resolve(), folder=folder)
    mesh: Mesh
    if thickness is None:
        mesh, surface = _filled(path, stage=stage, filling=filling, read=read)
    else:
        with located(path):
            mesh, surface = shell_of_file(open_surface(path), thickness=thickness)
    return Body(
        name=path.stem,
        mesh=mesh,
        file=None,
        folder=folder,
        surface=surface,
        surface_file=path.resolve(),
        up=_up(surface),
    )


def _up(surface: EmbeddedSurface | None) -> str | None:
    """The usual axis of a surface's file."""
    return None if surface is None or surface.source is None else surface.source.up


def _filled(
    path: Path,
    *,
    stage: Callable[..., None],
    filling: SurfaceFilling | None,
    read: Callable[[SurfaceFile], None] = lambda _: None,
) -> tuple[TetMesh, EmbeddedSurface]:
    """The tets inside the surface in a file, and the surface in them."""
    source = open_surface(path).compact()
    check_stop()
    try:
        check_points(source.vertices, who="surface")
        read(source)
        mesh = (filling or SurfaceFilling()).fill(source.vertices, source.faces, stage=stage)
        surface = embed_file(source, mesh, farthest=WHOLE_DIAGONAL)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    return mesh, surface


def model_body(model: ReducedModel, *, name: str, folder: Path) -> Body:
    """The body of a model, to choose other handles on.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
        A posing model gives its mesh and initial handles, an interpolation model its first pose
        without handles.
    name : str
        Name of the body.
    folder : Path
        Where files are saved.
    """
    mesh: Mesh
    if isinstance(model, InterpolationModel):
        mesh, problem = model.problem.poses.reference, None
    else:
        assert isinstance(model, PosingModel)
        mesh, problem = model.problem.mesh, model.problem
    own = len(model.surface.corners) != len(mesh.surface_vertices) or bool(
        (model.surface.nearest != mesh.surface_vertices).any()
    )
    return Body(
        name=name,
        mesh=mesh,
        file=None,
        folder=folder,
        problem=problem,
        surface=model.surface if own else None,
        up=model.up,
        mirror=model.mirror_plane,
        painted=painted_vertices(model),
    )
