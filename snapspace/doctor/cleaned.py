"""Faces without repeated vertices or duplicates, on points that are merged if needed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh.arrays import IndexArray
from ..mesh.edges import edges_of
from ..mesh.equal_faces import equal_faces
from ..mesh.surface_file.weld import equal_points

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Cleaned:
    """Faces whose edges can be counted.

    faces : (g, 3), without degenerate and duplicate ones; the indices are those of the input
    merged : number of points that were merged into others, because the surface is closed only then,
        or because faces coincide
    degenerate : number of faces with a repeated vertex, which were left out
    duplicate : number of faces with the vertices of another one, which were left out
    """

    faces: IndexArray
    merged: int
    degenerate: int
    duplicate: int


def cleaned(vertices: FloatArray, faces: IndexArray) -> Cleaned:
    """Leaves out useless faces.

    Merges equal points if the surface has boundary edges, or faces that coincide.
    """
    joined = _on_first_points(vertices, faces)
    merged = 0
    if _open(faces) or _repeat(joined):
        merged = len(np.unique(faces)) - len(np.unique(joined))
        faces = joined
    kept = _proper(faces)
    useless = repeated_faces(kept)
    if useless.any():
        useless |= _walls(kept)
    return Cleaned(kept[~useless], merged, len(faces) - len(kept), int(useless.sum()))


def coincide(vertices: FloatArray, faces: IndexArray) -> bool:
    """Whether two faces have the same three positions, as the sides of a wall between solids."""
    return _repeat(_on_first_points(vertices, faces))


def _on_first_points(vertices: FloatArray, faces: IndexArray) -> IndexArray:
    """The faces with the first of equal points instead of all of them."""
    first, group = equal_points(vertices)
    return np.asarray(first[group].astype(np.int32)[faces])


def _proper(faces: IndexArray) -> IndexArray:
    """The faces whose vertices are three different ones."""
    return np.asarray(faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)])


def _repeat(faces: IndexArray) -> bool:
    return bool(repeated_faces(_proper(faces)).any())


def _open(faces: IndexArray) -> bool:
    proper = _proper(faces)
    return not len(proper) or bool((edges_of(proper).uses == 1).any())


def repeated_faces(faces: IndexArray) -> NDArray[np.bool_]:
    """Which faces have the same three vertices as an earlier one."""
    copy = _copies(faces)
    first = np.full(len(faces), len(faces))
    np.minimum.at(first, copy, np.arange(len(faces)))
    return np.asarray(first[copy] != np.arange(len(faces)))


def _walls(faces: IndexArray) -> NDArray[np.bool_]:
    """Which faces have as many copies of opposite orientation, and leave no hole if dropped.

    They are both sides of a wall between solids, or of a sheet; neither shows what is inside.
    """
    copy = _copies(faces)
    # +1 where the vertices ascend cyclically, -1 where they descend
    way = np.sign(np.diff(faces, axis=1, append=faces[:, :1])).sum(axis=1)
    edges = edges_of(faces)
    even = (edges.uses[edges.of_face] % 2 == 0).all(axis=1)
    return np.asarray((np.bincount(copy, way)[copy] == 0) & even)


def _copies(faces: IndexArray) -> NDArray[np.intp]:
    """A number for each face, (f,), the same for faces with the same three vertices."""
    order, same = equal_faces(faces)
    copy = np.zeros(len(faces), np.intp)
    copy[order[1:]] = np.cumsum(~same)
    return copy
