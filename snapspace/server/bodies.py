"""problem_body, mesh_body, model_body: bodies from files and from models."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from ..filling import SurfaceFilling
from ..mesh import (
    SURFACE_SUFFIXES,
    TET_SUFFIXES,
    MirrorPlane,
    open_surface,
    read_tets,
)
from ..mesh import Body as Mesh
from ..mesh.input_path import existing_file
from ..notice import collected_notices
from ..page.painted import painted_vertices
from ..problem import (
    problem_surface_file,
    problem_thickness,
    read_problem,
    read_problem_surface,
)
from ..reduction import InterpolationModel, PosingModel, ReducedModel
from ..stopping import check_stop
from .body import Body, with_notices
from .opening import Opening
from .user_surface import UserSurface

PROBLEM_SUFFIX = ".json"
MESH_SUFFIXES = (*TET_SUFFIXES, *SURFACE_SUFFIXES)


def problem_body(path: Path, *, filling: SurfaceFilling | None = None) -> Body:
    """Mesh, handles and surface of a problem file; ValueError if one of them cannot be read.

    A surface without tets is filled unless it is a shell.
    """
    return with_notices(lambda: _problem_body(path, filling), folder=path.parent)


def _problem_body(path: Path, filling: SurfaceFilling | None) -> Body:
    own = problem_surface_file(path)
    if own is None or problem_thickness(path) is not None:
        problem = read_problem(path)
        surface = read_problem_surface(path, problem.mesh)
    else:
        filled = _read_surface(own).filled(filling or SurfaceFilling(), stage=lambda *_: None)
        problem, surface = read_problem(path, mesh=filled.mesh), filled.surface
    files = json.loads(path.read_text(encoding="utf-8-sig"))
    source = None if surface is None else surface.source
    return Body(
        name=path.stem,
        mesh=problem.mesh,
        file=None if own is not None else (path.parent / files["mesh"]).resolve(),
        folder=path.resolve().parent,
        problem=problem,
        surface=surface,
        surface_file=None if surface is None else (path.parent / files["surface"]).resolve(),
        up=files.get("up") or (None if source is None else source.up),
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
    read: Callable[[UserSurface], None] = lambda _: None,
) -> Body:
    """Tets from a file, or made inside the surface in a file, or that surface as a shell.

    Parameters
    ----------
    path : Path
    stage : callable
        Called with "reading" before the file is read and, for a surface, with the stages of
        `SurfaceFilling.fill`.
    filling : SurfaceFilling, optional
        How to fill a surface. Default: with quick tets; an open surface becomes a shell of the
        usual thickness instead.
    thickness : float, optional
        Thickness of the shell that a surface becomes, open or closed.
    read : callable, optional
        Called with a surface that has been read, before it is filled.

    Raises
    ------
    ValueError
        If the file cannot be read or filled, or cannot become a shell; the message begins with its
        path.
    """
    stage("reading")
    return read_mesh(path, filling=filling, thickness=thickness)(Opening(stage, read))


def read_mesh(
    path: Path, *, filling: SurfaceFilling | None = None, thickness: float | None = None
) -> Callable[[Opening], Body]:
    """Reads a mesh file; the returned function makes the body, and fills a surface.

    Arguments and ValueErrors are as for `mesh_body`; only filling may fail later.
    """
    existing_file(path, known=MESH_SUFFIXES)
    with collected_notices() as notices:
        make = _read_mesh(path, filling, thickness)
    return lambda opening: with_notices(
        lambda: make(opening), folder=path.parent, earlier=tuple(notices)
    )


def _read_mesh(
    path: Path, filling: SurfaceFilling | None, thickness: float | None
) -> Callable[[Opening], Body]:
    if path.suffix.lower() in TET_SUFFIXES:
        if thickness is not None:
            raise ValueError(f"{path}: a shell is made of a surface, not of tets")
        folder = path.resolve().parent
        tets = Body(name=path.stem, mesh=read_tets(path), file=path.resolve(), folder=folder)
        return lambda _: tets
    surface = _read_surface(path)
    shell = None if thickness is None else surface.shell(thickness)
    if filling is None and shell is None:
        shell = surface.own_shell()
    if shell is not None:
        return lambda _: shell

    def filled(opening: Opening) -> Body:
        opening.read(surface)
        return surface.filled(filling or SurfaceFilling(), stage=opening.stage)

    return filled


def _read_surface(path: Path) -> UserSurface:
    source = open_surface(path).compact()
    check_stop()
    place, folder = path.resolve(), path.resolve().parent
    surface = UserSurface(name=path.stem, source=source, folder=folder, path=place)
    surface.check()
    return surface


def model_body(model: ReducedModel, *, name: str, folder: Path) -> Body:
    """The body of a model, to choose other handles on; it keeps the model.

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
        model=model,
    )
