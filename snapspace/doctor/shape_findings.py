"""Findings about the shape of a surface: slivers, thinness, position, size, intersections."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..counted import counted
from ..mesh import triangle_areas
from .finding import AS_SHELL, Finding
from .intersections import crossing_faces

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]

# Height over longest side below which a face is a sliver.
_SLIVER = 0.01
# A mean thickness below this share of the diagonal is thin: default tets have about that size.
_THIN = 0.02
# Distance from the origin, in diagonals, at which single precision rounds by 0.001 %.
_FAR = 100.0


def face_areas(vertices: FloatArray, faces: IndexArray) -> tuple[FloatArray, FloatArray]:
    """Areas of faces, and their heights over the longest side divided by that side, (f,) each."""
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    area = triangle_areas(vertices, faces)
    longest = np.maximum.reduce([((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))])
    shape = np.divide(2.0 * area, longest, out=np.zeros_like(area), where=longest > 0)
    return area, shape


def sliver_finding(shape: FloatArray) -> list[Finding]:
    """Faces that are almost lines; harmless for filling."""
    count = int((shape < _SLIVER).sum())
    if not count:
        return []
    return [
        Finding(
            name="slivers",
            fault=False,
            count=count,
            text=f"{counted(count, 'face is', 'faces are')} less than 1 % as high as long",
            meaning="harmless: tets have their own faces, and normals are weighted by area",
            cure="nothing",
        )
    ]


def thin_finding(volume: float, area: float, diagonal: float) -> list[Finding]:
    """A closed surface whose interior is thin or empty."""
    thickness = 2.0 * abs(volume) / (area * diagonal) if area > 0 else 0.0
    if thickness >= _THIN:
        return []
    if thickness < 1e-9:
        return [flat_finding()]
    return [
        Finding(
            name="thin",
            fault=False,
            count=1,
            text=f"its parts are {100 * thickness:.2g} % of the diagonal thick on average",
            meaning="tets are about as long as a part is thick, so many smaller ones are needed",
            cure="nothing; if it cannot be filled, use a shell, or thicken it",
            details={"thickness": thickness},
        )
    ]


def flat_finding(*, sheet: bool = False) -> Finding:
    """A surface without an inside; a `sheet` may be open on purpose, as cloth is."""
    cures = ["give it a thickness (Blender: the modifier Solidify)", AS_SHELL]
    return Finding(
        name="flat",
        fault=True,
        count=1,
        text="the surface encloses no volume",
        meaning="tets fill solids; a sheet has no inside",
        cure="; or ".join(cures if sheet else cures[:1]),
        details={"sheet": True} if sheet else {},
    )


def place_finding(center: FloatArray, diagonal: float) -> list[Finding]:
    """A surface far from the origin for its size."""
    distance = float(np.abs(center).max())
    if distance <= _FAR * diagonal:
        return []
    return [
        Finding(
            name="place",
            fault=False,
            count=1,
            text=f"it is {distance / diagonal:.3g} of its diagonals away from the origin",
            meaning="Snapspace computes in double precision, but .stl, .glb and graphics "
            "processors lose digits",
            cure="move it to the origin",
        )
    ]


def crossing_finding(vertices: FloatArray, faces: IndexArray) -> list[Finding]:
    """Faces that cross."""
    pairs = crossing_faces(vertices, faces)
    if not len(pairs):
        return []
    first, second = pairs[0].tolist()
    return [
        Finding(
            name="self-intersections",
            fault=True,
            count=len(pairs),
            text=f"{counted(len(pairs), 'pair of faces crosses', 'pairs of faces cross')} "
            f"(the first: {first} and {second})",
            meaning="tets make one solid of overlapping parts, so these cannot move apart",
            cure="nothing, if they belong together; otherwise part them in a mesh editor",
            details={"pairs": pairs[:100].tolist()},
        )
    ]
