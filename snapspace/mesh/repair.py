"""Making a valid mesh from tets that have curable faults."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..input_error import InputError
from .arrays import FloatArray, IndexArray, as_indices, as_points
from .components import tet_components
from .joined_parts import joined_parts
from .quality import flat_tets, tet_volumes
from .tet_mesh import TetMesh
from .validation import check_values, duplicate_tets, repeated_vertex


def repair_tets(vertices: ArrayLike, tets: ArrayLike) -> tuple[TetMesh, list[str]]:
    """Repair faults that `TetMesh` refuses, as far as this needs no guess about the shape.

    In this order, it merges vertices of different components that have the same position; drops
    tets that repeat a vertex, repeat another tet or have no volume; reorients inverted tets by
    swapping two of their vertices; keeps the component with the most tets; and drops vertices that
    belong to no tet.

    Parameters
    ----------
    vertices : array_like, (n, 3)
    tets : array_like of int, (m, 4)

    Returns
    -------
    mesh : TetMesh
        What remains keeps its order; a valid mesh is returned unchanged.
    notes : list of str
        What was done, one sentence per kind of fault; empty if nothing was.

    Raises
    ------
    ValueError
        For wrong shapes or types, coordinates that are not finite, an index out of range, or if no
        tet is left.
    """
    points = as_points(vertices, who="repair_tets")
    kept = as_indices(tets, corners=4, who="repair_tets", what="tets")
    check_values(points, kept, who="repair_tets")
    notes: list[str] = []
    points, kept = _join(points, kept, notes)
    kept = _drop_degenerate(points, kept, notes)
    kept = _reorient(points, kept, notes)
    kept = _keep_largest(points, kept, notes)
    points, kept = _drop_unused(points, kept, notes)
    return TetMesh(points, kept), notes


def _join(points: FloatArray, tets: IndexArray, notes: list[str]) -> tuple[FloatArray, IndexArray]:
    joined, merged_tets, merged = joined_parts(points, tets)
    if merged:
        notes.append(
            f"merged {merged} of {len(points)} vertices with others at the same position, which "
            "joins components"
        )
    return joined, merged_tets


def _drop_degenerate(points: FloatArray, tets: IndexArray, notes: list[str]) -> IndexArray:
    tets = _drop(tets, repeated_vertex(tets), "with a repeated vertex", notes)
    tets = _drop(tets, duplicate_tets(tets), "with the same vertices as an earlier tet", notes)
    return _drop(tets, flat_tets(points, tets, tet_volumes(points, tets)), "of zero volume", notes)


def _drop(tets: IndexArray, bad: NDArray[np.bool_], which: str, notes: list[str]) -> IndexArray:
    count = int(bad.sum())
    if count == len(tets):
        raise InputError(
            "repair_tets", f"no tet would be left after dropping the {count} tets {which}"
        )
    if count:
        notes.append(f"dropped {count} of {len(tets)} tets {which}")
        return tets[~bad]
    return tets


def _reorient(points: FloatArray, tets: IndexArray, notes: list[str]) -> IndexArray:
    inverted = tet_volumes(points, tets) < 0
    count = int(inverted.sum())
    if not count:
        return tets
    notes.append(f"reoriented {count} of {len(tets)} tets, which were inverted")
    tets = tets.copy()
    tets[inverted] = tets[inverted][:, [0, 2, 1, 3]]
    return tets


def _keep_largest(points: FloatArray, tets: IndexArray, notes: list[str]) -> IndexArray:
    component = tet_components(tets, len(points))
    count = int(component.max()) + 1
    if count == 1:
        return tets
    kept: IndexArray = tets[component == 0]
    notes.append(f"kept the largest of {count} components, {len(kept)} of {len(tets)} tets")
    return kept


def _drop_unused(
    points: FloatArray, tets: IndexArray, notes: list[str]
) -> tuple[FloatArray, IndexArray]:
    used = np.zeros(len(points), dtype=np.bool_)
    used[tets] = True
    count = int(np.count_nonzero(~used))
    if not count:
        return points, tets
    notes.append(f"dropped {count} of {len(points)} vertices, which belong to no tet")
    new_index: IndexArray = np.cumsum(used, dtype=np.int32) - np.int32(1)
    return points[used], new_index[tets]
