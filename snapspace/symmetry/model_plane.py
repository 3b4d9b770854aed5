"""The mirror plane of a model."""

from __future__ import annotations

from ..mesh import MirrorPlane
from ..reduction import PosingModel
from .plane_search import mirror_plane


def plane_of(model: PosingModel) -> MirrorPlane:
    """The plane that the model's record names, else that of the surface that it shows.

    ValueError as for `mirror_plane`.
    """
    surface = model.surface
    rest = surface.vertices(model.problem.mesh.vertices)
    return model.mirror_plane or mirror_plane(rest, surface.faces)
