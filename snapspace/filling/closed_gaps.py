"""notice_closed_gaps: a notice if tets have another topology than the surface that they fill."""

from __future__ import annotations

from ..counted import counted
from ..mesh import MeshNotice, TetMesh
from ..notice import notify
from ..stuffing.manifold import euler_characteristic
from .closed_input import ClosedInput


def notice_closed_gaps(mesh: TetMesh, surface: ClosedInput) -> None:
    """A `MeshNotice` if the tets join parts that the surface keeps apart, or close holes in it.

    The boundary of the tets then has another Euler characteristic.
    """
    found, wanted = (euler_characteristic(faces) for faces in (mesh.surface, surface.faces))
    if found == wanted:
        return
    # each loop takes two from the Euler characteristic
    places = counted(max(abs(found - wanted) // 2, 1), "place", "places")
    if found < wanted:
        what = f"join parts of the surface that nearly touch, in {places}"
    else:
        what = f"close narrow holes through the surface, in {places}"
    notify(
        f"the tets {what}; a shorter edge length or fTetWild (--exact, `fill_surface`) may keep "
        "them open",
        MeshNotice,
        stacklevel=3,
    )
