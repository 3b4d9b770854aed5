"""ClosedInput: a closed surface, checked and scaled for the fillers."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import is_number, shown
from ..counted import counted
from ..doctor.cleaned import coincide
from ..doctor.edge_findings import DUST
from ..doctor.mend_surface import mend_surface
from ..doctor.minor_parts import minor_parts
from ..doctor.parts_apart import parts_apart
from ..input_error import InputError
from ..mesh import MeshNotice, compact_surface
from ..mesh.arrays import FloatArray, IndexArray, as_indices, as_points
from ..mesh.closed_surface import check_closed, enclosed_volume, is_flat
from ..mesh.edges import edges_of
from ..mesh.validation import check_indices, check_points
from ..notice import notify
from .outward import facing_outward


class NoSolidError(ValueError):
    """A surface that no method can fill: it is flat, or has separate parts."""


@dataclass(frozen=True, kw_only=True)
class ClosedInput:
    """A checked surface, centred at the origin with diagonal one, oriented outward part by part.

    vertices : ndarray, (s, 3)
    faces : ndarray of int32, (f, 3)
    center : ndarray, (3,)
        Centre of the given surface's bounding box.
    diagonal : float
        Diagonal of the given surface's bounding box.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int32]
    center: NDArray[np.float64]
    diagonal: float


def closed_input(
    vertices: ArrayLike, faces: ArrayLike, *, who: str, mend: bool = False, leave_open: bool = False
) -> ClosedInput:
    """Checks, orients and scales a surface; ValueError unless it encloses a solid.

    With `mend`, a surface that is not closed or not consistently oriented, or has faces that
    coincide, is mended, see `mend_surface`, and a `MeshNotice` says what was done. Parts that stay
    open and have less than half of the area are left out. With `leave_open` as well, the result may
    still be open.
    """
    points = as_points(vertices, who=who)
    triangles = as_indices(faces, corners=3, who=who, what="faces")
    check_points(points, who=who)
    check_indices(triangles, len(points), who=who, what="face")
    if len(triangles) and is_flat(points, triangles):
        raise _no_volume(triangles, who=who)
    closed = True
    try:
        check_closed(triangles, who=who)
    except InputError as error:
        if not mend or not len(triangles):
            raise
        points, triangles, closed = _mended(points, triangles, error.place, leave_open=leave_open)
    else:
        if mend and coincide(points, triangles):
            with suppress(ValueError):  # it is closed only with the faces that coincide: they stay
                points, triangles, _ = _mended(points, triangles, who)
    triangles = _one_part(points, triangles, who=who)
    points, triangles = compact_surface(points, triangles)
    center = (points.min(axis=0) + points.max(axis=0)) / 2.0
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    # fillers have absolute thresholds, so all surfaces are scaled to the same size
    scaled = (points - center) / (diagonal or 1.0)
    volume = enclosed_volume(scaled, triangles)
    if closed and abs(volume) < np.finfo(np.float64).eps:
        raise _no_volume(triangles, who=who)
    outward = facing_outward(scaled, triangles, closed=closed)
    turned = (outward != triangles).any(axis=1)
    if turned.any() and not turned.all():
        what = "parts of the surface were inside out, and were turned for filling"
        notify(what, MeshNotice, stacklevel=3)
    return ClosedInput(vertices=scaled, faces=outward, center=center, diagonal=diagonal)


def _mended(
    points: FloatArray, triangles: IndexArray, who: str, *, leave_open: bool = False
) -> tuple[FloatArray, IndexArray, bool]:
    """Vertices and faces, and whether they are closed now; the error if they must be."""
    mended = mend_surface(points, triangles)
    done = [f"the surface was mended for filling: {'; '.join(mended.notes)}"] * bool(mended.notes)
    edges = edges_of(mended.faces)
    open_parts = minor_parts(mended.vertices, mended.faces, edges.ends[edges.uses % 2 == 1])
    if open_parts.any():
        done.append(
            "open parts of the surface, such as cloth or hair, are left out of the tets, and "
            "carried by the nearest ones"
        )
    left = mended.faces[~open_parts]
    try:
        check_closed(left, who=who)
        closed = True
    except InputError as error:
        if not leave_open:
            raise
        closed = False
        done.append(f"{error.fault.partition(':')[0]}, so the winding number determines the inside")
    notify(f"{'; '.join(done)}; `snapspace check` says more", MeshNotice, stacklevel=4)
    return mended.vertices, left, closed


def _no_volume(triangles: IndexArray, *, who: str) -> NoSolidError:
    return NoSolidError(
        f"{who}: the surface encloses no volume ({len(triangles)} faces), but a solid "
        "is needed; check that the surface is neither flat nor doubly covered"
    )


def _one_part(points: FloatArray, triangles: IndexArray, *, who: str) -> IndexArray:
    """The triangles without small separate parts; ValueError for large ones."""
    group, share = parts_apart(points, triangles)
    large = int((share > DUST).sum())
    if large > 1:
        faces = np.bincount(group)[1]
        low, high = (pick(points[triangles[group == 1]], axis=(0, 1)) for pick in (np.min, np.max))
        center = ", ".join(f"{x:.4g}" for x in (low + high) / 2.0)
        raise NoSolidError(
            f"{who}: the surface has {large} separate parts (the second largest: {faces} "
            f"faces around ({center})), but one solid is needed; join them, or remove all but one"
        )
    if len(share) > 1:
        small = "small part of the surface is", "small parts of the surface are"
        notify(
            f"{counted(len(share) - 1, *small)} apart, left out of the tets, and carried by the "
            "nearest ones",
            MeshNotice,
            stacklevel=4,
        )
    return np.asarray(triangles[group == 0])


def check_share(value: float, name: str, *, largest: float, who: str) -> None:
    """Raises ValueError unless a share of the diagonal is positive and not too large."""
    if not (is_number(value) and 0 < value <= largest):
        raise ValueError(
            f"{who}: {name} is {shown(value)}, but must be positive and at most {largest:g}; it is "
            "a share of the diagonal"
        )
