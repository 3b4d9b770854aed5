"""Whether vertex i of several meshes is the same point: equal vertex counts and equal cells."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray, IndexArray

_CURE = "export all poses from one mesh, without reordering or merging vertices"


def check_same_faces(
    surfaces: Sequence[tuple[FloatArray, IndexArray]], names: Sequence[str]
) -> None:
    """Raise ValueError unless all surfaces have the first one's vertex count and faces.

    Parameters
    ----------
    surfaces : sequence of (vertices (n, 3), faces (f, 3))
        For example from `read_surface`.
    names : sequence of str
        One per surface, for the message.

    Raises
    ------
    ValueError
        For different vertex counts, face counts or faces, in this order. The message names the
        first surface that differs and, for faces, the first face that does, with its vertices in
        both surfaces. The same triangle beginning at another corner counts as different.
    """
    _check_same_cells(surfaces, names, singular="face")


def check_same_tets(meshes: Sequence[tuple[FloatArray, IndexArray]], names: Sequence[str]) -> None:
    """As `check_same_faces`, for (vertices (n, 3), tets (m, 4)) of tet meshes."""
    _check_same_cells(meshes, names, singular="tet")


def _check_same_cells(
    meshes: Sequence[tuple[FloatArray, IndexArray]], names: Sequence[str], *, singular: str
) -> None:
    (first_vertices, first_cells), *others = meshes
    first_name = names[0]
    for name, (vertices, cells) in zip(names[1:], others, strict=True):
        for what, count, wanted in (
            ("vertices", len(vertices), len(first_vertices)),
            (f"{singular}s", len(cells), len(first_cells)),
        ):
            if count != wanted:
                raise ValueError(
                    f"{name}: has {count} {what}, but {first_name} has {wanted}; {_CURE}"
                )
        differing = np.flatnonzero((cells != first_cells).any(axis=1))
        if differing.size:
            row = differing[0]
            raise ValueError(
                f"{name}: {singular} {row} has vertices {_indices(cells[row])}, but in "
                f"{first_name} {_indices(first_cells[row])}; {differing.size} of {len(cells)} "
                f"{singular}s differ: {_CURE}"
            )


def _indices(values: NDArray[np.signedinteger]) -> str:
    return ", ".join(str(value) for value in values)
