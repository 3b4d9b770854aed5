"""Tets that join parts which their surface keeps apart, or close holes in it."""

from __future__ import annotations

from ..counted import counted
from ..mesh import MeshNotice, TetMesh
from ..notice import notify
from ..stuffing.manifold import euler_characteristic
from .closed_input import ClosedInput


def wrong_loops(mesh: TetMesh, surface: ClosedInput) -> int:
    """How many loops more, or fewer, the boundary of the tets has than the surface."""
    # each loop takes two from the Euler characteristic
    return abs(_difference(mesh, surface)) // 2


def notice_closed_gaps(mesh: TetMesh, surface: ClosedInput) -> None:
    """A `MeshNotice` if the tets join parts that the surface keeps apart, or close holes in it."""
    difference = _difference(mesh, surface)
    if difference == 0:
        return
    places = counted(abs(difference) // 2, "place", "places")
    if difference < 0:
        what = f"join parts of the surface that nearly touch, in {places}"
    else:
        what = f"close narrow holes through the surface, in {places}"
    notify(
        f"the tets {what}; a shorter edge length or fTetWild (--exact, `fill_surface`) may keep "
        "them open",
        MeshNotice,
        stacklevel=3,
    )


def _difference(mesh: TetMesh, surface: ClosedInput) -> int:
    """Euler characteristic of the tets' boundary, without that of the surface."""
    return euler_characteristic(mesh.surface) - euler_characteristic(surface.faces)
