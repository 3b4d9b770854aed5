"""Faces without repeated vertices and copies, on points that are merged if that is needed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..mesh.surface_file.weld import equal_points
from .edges import IndexArray, edges_of

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Cleaned:
    """Faces that edges can be counted on.

    faces : (g, 3), without degenerate and duplicate ones; the indices are those of the input
    merged : number of points that became another one, because the surface is closed only so
    degenerate : number of faces with a repeated vertex, which were left out
    duplicate : number of faces with the vertices of an earlier one, which were left out
    """

    faces: IndexArray
    merged: int
    degenerate: int
    duplicate: int


def cleaned(vertices: FloatArray, faces: IndexArray) -> Cleaned:
    """Leaves out useless faces; merges equal points if the surface has boundary edges."""
    merged = 0
    if _open(faces):
        first, group = equal_points(vertices)
        used = np.unique(faces)
        target = first[group].astype(np.int32)
        merged = int((target[used] != used).sum())
        faces = target[faces]
    repeated = (faces == np.roll(faces, 1, axis=1)).any(axis=1)
    kept = faces[~repeated]
    again = repeated_faces(kept)
    return Cleaned(kept[~again], merged, int(repeated.sum()), int(again.sum()))


def _open(faces: IndexArray) -> bool:
    proper = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    return not len(proper) or bool((edges_of(proper).uses == 1).any())


def repeated_faces(faces: IndexArray) -> NDArray[np.bool_]:
    """Which faces have the same three vertices as an earlier one."""
    corners = np.sort(faces, axis=1)
    order = np.lexsort((corners[:, 2], corners[:, 1], corners[:, 0]))
    same = (np.diff(corners[order], axis=0) == 0).all(axis=1)
    again = np.zeros(len(faces), np.bool_)
    again[order[1:][same]] = True
    return again
