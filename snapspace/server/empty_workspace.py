"""The first messages to a page: it has no mesh yet, or only a surface."""

from __future__ import annotations

from dataclasses import replace

from ..accurate import MOTIONS
from ..material import DEFAULT_MATERIAL
from ..mesh import SurfaceFile
from . import messages
from .materials import material_choices, shown_poisson
from .mesh_pack import diagonal_of
from .settings import ServerSettings


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
        poisson=shown_poisson(DEFAULT_MATERIAL()),
        folder=str(settings.folder),
        upload_limit=settings.upload_limit,
    )


def surface_workspace(
    empty: messages.Workspace, surface: SurfaceFile, *, name: str, mesh: str
) -> messages.Workspace:
    """The workspace while a surface is filled, from an empty one and the address `mesh`."""
    return replace(
        empty,
        kind="surface",
        name=name,
        mesh=mesh,
        diagonal=diagonal_of(surface),
        up=surface.up,
        has_surface=True,
    )
