"""The surface that a model shows."""

from __future__ import annotations

from ..arguments import require_type
from ..mesh import Body, EmbeddedSurface, boundary_surface


def surface_in(mesh: Body, surface: EmbeddedSurface | None, *, who: str) -> EmbeddedSurface:
    """The surface, or the boundary of the tets if None; ValueError if it is of another mesh."""
    cure = "give that of embed_surface or boundary_surface"
    require_type(who, "surface", surface, EmbeddedSurface | None, cure)
    shown = boundary_surface(mesh) if surface is None else surface
    if len(shown.corners) and shown.corners.max() >= len(mesh.vertices):
        raise ValueError(
            f"{who}: the surface follows vertex {shown.corners.max()}, but the mesh has "
            f"{len(mesh.vertices)} vertices; embed it in the problem's mesh"
        )
    return shown
