"""Tets that join parts which their surface keeps apart, or close holes in it."""

from __future__ import annotations

from ..counted import counted
from ..mesh import MeshNotice, TetMesh
from ..notice import notify
from ..stuffing.manifold import euler_characteristic
from .enclosed_solid import EnclosedSolid


def wrong_loops(mesh: TetMesh, solid: EnclosedSolid) -> int:
    """How many loops more, or fewer, the boundary of the tets has than the surface, if known."""
    # each loop takes two from the Euler characteristic
    return abs(_difference(mesh, solid)) // 2


def notice_joined(mesh: TetMesh, solid: EnclosedSolid) -> None:
    """A `MeshNotice` if the tets join parts of the surface, or close holes in it."""
    difference = _difference(mesh, solid)
    places = counted(abs(difference) // 2, "place", "places")
    cure = "a shorter edge length or fTetWild (--exact, `fill_surface`) may keep them open"
    if solid.is_joined:
        what = "make one solid of separate parts that overlap"
    elif difference < 0:
        what = f"join parts of the surface that nearly touch, in {places}; {cure}"
    elif difference > 0:
        what = f"close narrow holes through the surface, in {places}; {cure}"
    else:
        return
    notify(f"the tets {what}", MeshNotice, stacklevel=3)


def _difference(mesh: TetMesh, solid: EnclosedSolid) -> int:
    """Euler characteristic of the tets' boundary, without that of the surface; 0 if unknown."""
    if solid.is_joined:
        return 0
    return euler_characteristic(mesh.surface) - euler_characteristic(solid.faces)
