"""Reopening: converts a surface to a shell or to a solid."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ..filling import SurfaceFilling
from ..material import Material
from . import messages
from .body import Body, with_notices
from .materials import usual_kind
from .opening import Opening
from .user_surface import UserSurface


def reopening(
    surface: UserSurface, thickness: float | None, filling: SurfaceFilling | None
) -> Callable[[Opening], Body]:
    """Makes the shell of a thickness, or the solid inside the surface for None.

    ValueError at once if the surface or the thickness is invalid for a shell; filling may fail
    later.
    """
    if thickness is not None:
        shell = surface.shell(thickness)
        return lambda _: with_notices(lambda: shell)

    def fill(opening: Opening) -> Body:
        opening.read(surface)
        tets = filling or SurfaceFilling()
        return with_notices(lambda: surface.filled(tets, stage=opening.stage))

    return fill


def surface_of(body: Body) -> UserSurface:
    """The surface that a body was made of; ValueError if it came as tets."""
    source = None if body.surface is None else body.surface.source
    if source is None:
        raise ValueError("this mesh came as tets, or without the file of its surface")
    material = body.material if body.problem is None else body.problem.material
    return UserSurface(
        name=body.name,
        source=source,
        folder=body.folder,
        path=body.surface_file,
        up=body.up,
        mirror=body.mirror,
        material=material,
    )


def in_another_form(
    kept: messages.Keep, thickness: float | None, given: Material | None
) -> messages.Keep:
    """The choices for a body that becomes a shell of a thickness, or a solid for None.

    Parameters
    ----------
    given : Material or None
        Material of the body; None: the usual one. The usual one of the old form is replaced by that
        of the new form.
    """
    before, after = (usual_kind(given, shell=t is not None) for t in (kept.thickness, thickness))
    material = after if kept.material == before else kept.material
    return replace(kept, thickness=thickness, material=material)
