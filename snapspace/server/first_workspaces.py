"""The first messages to a page: it has no mesh yet, only a surface, or a mesh."""

from __future__ import annotations

from dataclasses import fields, replace

from ..accurate import MOTIONS
from ..material import DEFAULT_MATERIAL, Material
from ..mesh import ShellMesh, TetMesh
from . import messages
from .body import Body
from .body_choice import shown_thickness
from .materials import fitted_material, material_choices, shown_poisson, usual_kind
from .selection import ANGLE, TRANSLATION_SHARE, as_vector, choices_of
from .settings import ServerSettings
from .surface_regions import SurfaceRegions
from .user_surface import UserSurface, is_open, usual_thickness


def empty_workspace(settings: ServerSettings, *, name: str, up: str) -> messages.Workspace:
    """A workspace without a mesh, with the usual choices; `name` is its id."""
    return messages.Workspace(
        id=name,
        kind="empty",
        name=settings.title,
        mesh=None,
        up=up,
        handles=(),
        translation=(0.0, 0.0, 0.0),
        angle=(0.0, 0.0, 0.0),
        diagonal=0.0,
        target_error=MOTIONS.target,
        seed=0,
        stiffness=1000.0,
        materials=material_choices(),
        material=DEFAULT_MATERIAL.kind,
        solid_material=usual_kind(None, shell=False),
        shell_material=usual_kind(None, shell=True),
        poisson=shown_poisson(DEFAULT_MATERIAL()),
        folder=str(settings.folder),
        upload_limit=settings.upload_limit,
    )


def surface_workspace(
    empty: messages.Workspace, surface: UserSurface, *, mesh: str
) -> messages.Workspace:
    """The workspace while a surface is filled, from an empty one and the address `mesh`."""
    return replace(
        empty,
        kind="surface",
        name=surface.name,
        mesh=mesh,
        diagonal=surface.diagonal,
        up=surface.up or surface.source.up,
        has_surface=True,
        usual_thickness=usual_thickness(surface.diagonal),
    )


def mesh_workspace(
    empty: messages.Workspace,
    body: Body,
    material: Material | None,
    regions: SurfaceRegions | None,
    *,
    mesh: str,
) -> messages.Workspace:
    """The workspace of a body, with the handles and ranges of its problem if it has one.

    Parameters
    ----------
    empty : Workspace
        The workspace of a page without a mesh.
    body : Body
    material : Material or None
        The initial material; None: the usual one.
    regions : SurfaceRegions or None
        The regions of the body's own surface, if it has one.
    mesh : str
        The address of the packed mesh.
    """
    shape, surface, problem = body.mesh, body.surface, body.problem
    length = TRANSLATION_SHARE * shape.diagonal
    has_source = surface is not None and surface.source is not None
    known = replace(
        empty,
        kind="mesh",
        name=body.name,
        mesh=mesh,
        diagonal=shape.diagonal,
        translation=(length, length, length),
        angle=(ANGLE, ANGLE, ANGLE),
        material=fitted_material(material, shape).kind,
        solid_material=usual_kind(material, shell=False),
        shell_material=usual_kind(material, shell=True),
        poisson=shown_poisson(material or DEFAULT_MATERIAL()),
        folder=str(body.folder),
        up=body.up or empty.up,
        has_surface=surface is not None,
        thickness=shown_thickness(shape),
        usual_thickness=usual_thickness(shape.diagonal)
        if has_source or isinstance(shape, ShellMesh)
        else None,
        is_filled=isinstance(shape, TetMesh),
        is_open=is_open(shape),
        notices=tuple(text.replace("`snapspace check`", "Check surface") for text in body.notices),
    )
    if problem is None:
        return known
    bounds = problem.domain.common.bounds[0]
    choices = choices_of(problem)
    return replace(
        known,
        handles=choices if regions is None else regions.shown(choices, body.painted),
        translation=as_vector(bounds[:3]),
        angle=as_vector(bounds[3:]),
    )


def with_choices(begun: messages.Workspace, kept: messages.Keep | None) -> messages.Workspace:
    """The workspace of a mesh with the page's choices since it was sent."""
    if kept is None or begun.kind != "mesh":
        return begun
    chosen = {field.name: getattr(kept, field.name) for field in fields(kept)}
    del chosen["request"]
    chosen |= {"poisson": begun.poisson, "own_poisson": kept.poisson}
    return replace(begun, **chosen)


def axis_up(
    settings: ServerSettings,
    kept: messages.Keep | None,
    body: Body | None,
    surface: UserSurface | None,
) -> str:
    """The axis that points up, from the page's choices, the server's settings or the file."""
    if kept is not None:
        return kept.up
    if settings.up is not None:
        return settings.up
    if body is not None:
        return body.up or "z"
    if surface is not None:
        return surface.up or surface.source.up
    return "z" if settings.model is None else settings.model.up
