"""Checks of a tet mesh; each message names the first offender, the count and the cure."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..counted import counted
from ..input_error import InputError
from .arrays import FloatArray, IndexArray
from .components import tet_components
from .joined_parts import joined_parts
from .quality import flat_tets, tet_volumes

_CURE = "snapspace.repair_tets(vertices, tets) (command line: --repair)"


def check_mesh(vertices: FloatArray, tets: IndexArray, *, who: str) -> FloatArray:
    """Raise ValueError unless the arrays form a valid mesh; return the tets' volumes, (m,)."""
    check_values(vertices, tets, who=who)
    _check_tets(tets, len(vertices), who=who)
    with np.errstate(over="ignore", invalid="ignore"):
        volumes = tet_volumes(vertices, tets)
    _check_volumes(vertices, tets, volumes, who=who)
    _check_vertices(tets, len(vertices), who=who)
    _check_one_component(vertices, tets, who=who)
    return volumes


def check_values(vertices: FloatArray, tets: IndexArray, *, who: str) -> None:
    """Raise ValueError for faults without repair: no tets, not finite, index out of range."""
    if not len(tets):
        raise InputError(who, "there are no tets; at least one is needed")
    check_points(vertices, who=who)
    check_indices(tets, len(vertices), who=who, what="tet")


def check_points(vertices: FloatArray, *, who: str) -> None:
    """Raise ValueError for coordinates that are not finite."""
    bad = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
    if bad.size:
        x, y, z = vertices[bad[0]]
        raise InputError(
            who,
            f"vertex {bad[0]} is not finite ({x:g}, {y:g}, {z:g}); "
            f"{counted(bad.size, 'vertex', 'vertices')} of {len(vertices)} affected: correct the "
            "coordinates at their source",
        )


def check_indices(rows: IndexArray, vertex_count: int, *, who: str, what: str) -> None:
    """Raise ValueError for vertex indices that are out of range."""
    if rows.size and 0 <= rows.min() and rows.max() < vertex_count:
        return
    bad = np.argwhere((rows < 0) | (rows >= vertex_count))
    if bad.size:
        row, corner = bad[0]
        index = rows[row, corner]
        hint = ""
        if rows.min() >= 1 and rows.max() == vertex_count:
            hint = "; the indices seem to start at 1: subtract 1 from all of them"
        raise InputError(
            who,
            f"{what} {row} has vertex index {index}, but vertices has {vertex_count} rows{hint}",
        )


def repeated_vertex(tets: IndexArray) -> NDArray[np.bool_]:
    """Which tets name a vertex more than once, (m,)."""
    ordered = np.sort(tets, axis=1)
    return np.asarray((ordered[:, 1:] == ordered[:, :-1]).any(axis=1), dtype=np.bool_)


def duplicate_tets(tets: IndexArray) -> NDArray[np.bool_]:
    """Which tets have the same four vertices as an earlier tet, (m,)."""
    ordered = np.sort(tets, axis=1)
    # Sums of random 64-bit numbers per vertex find the few candidates fast; the candidates are
    # compared exactly, so the result does not depend on chance.
    salt = np.random.default_rng(0).integers(0, 2**63, size=int(tets.max()) + 1, dtype=np.uint64)
    keys = salt[ordered].sum(axis=1, dtype=np.uint64)
    sorted_keys = np.sort(keys)
    suspects = np.flatnonzero(np.isin(keys, sorted_keys[1:][sorted_keys[1:] == sorted_keys[:-1]]))
    result = np.zeros(len(tets), dtype=np.bool_)
    if suspects.size:
        _, first = np.unique(ordered[suspects], axis=0, return_index=True)
        result[np.delete(suspects, first)] = True
    return result


def _check_tets(tets: IndexArray, vertex_count: int, *, who: str) -> None:
    bad = np.flatnonzero(repeated_vertex(tets))
    if bad.size:
        raise InputError(
            who,
            f"tet {bad[0]} repeats a vertex ({_indices(tets[bad[0]])}); "
            f"{counted(bad.size, 'such tet')} of {len(tets)}: drop with {_CURE}",
        )
    bad = np.flatnonzero(duplicate_tets(tets))
    if bad.size:
        raise InputError(
            who,
            f"tet {bad[0]} has the same four vertices as an earlier tet "
            f"({_indices(tets[bad[0]])}); {counted(bad.size, 'such tet')} of {len(tets)}: "
            f"drop with {_CURE}",
        )


def _check_volumes(
    vertices: FloatArray, tets: IndexArray, volumes: FloatArray, *, who: str
) -> None:
    if not np.isfinite(volumes).all():
        raise InputError(
            who,
            f"coordinates up to {np.abs(vertices).max():g} are too large for the volumes to "
            "be computed: choose another unit of length",
        )
    bad = np.flatnonzero(flat_tets(vertices, tets, volumes))
    if bad.size == len(tets):
        # dropping them would leave no tets
        raise InputError(
            who,
            f"every tet ({len(tets)}) has zero volume: the vertices are in one plane, too close "
            "together, or too far from the origin for double precision (coordinates up to "
            f"{np.abs(vertices).max():g}); move or scale them at their source",
        )
    if bad.size:
        raise InputError(
            who,
            f"tet {bad[0]} ({_indices(tets[bad[0]])}) has zero volume; "
            f"{counted(bad.size, 'such tet')} of {len(tets)}: drop with {_CURE}",
        )
    bad = np.flatnonzero(volumes < 0)
    if bad.size == len(tets):
        raise InputError(
            who,
            f"every tet ({len(tets)}) is inverted (negative volume): their source orders "
            f"vertices the other way; flip with tets[:, [0, 2, 1, 3]] or {_CURE}",
        )
    if bad.size:
        raise InputError(
            who,
            f"tet {bad[0]} ({_indices(tets[bad[0]])}) is inverted (volume "
            f"{volumes[bad[0]]:g}); {counted(bad.size, 'such tet')} of {len(tets)}: "
            f"flip with {_CURE}",
        )


def _check_vertices(tets: IndexArray, vertex_count: int, *, who: str) -> None:
    unused = np.flatnonzero(np.bincount(tets.ravel(), minlength=vertex_count) == 0)
    if unused.size:
        raise InputError(
            who,
            f"vertex {unused[0]} belongs to no tet; "
            f"{counted(unused.size, 'such vertex', 'such vertices')} of {vertex_count}: "
            f"drop with {_CURE}",
        )


def _check_one_component(vertices: FloatArray, tets: IndexArray, *, who: str) -> None:
    sizes = np.bincount(tet_components(tets, len(vertices)))
    if len(sizes) > 1:
        more = ", ..." if len(sizes) > 5 else ""
        _, _, merged = joined_parts(vertices, tets)
        cure = f"keep the largest with {_CURE}, or mesh the parts as one"
        if merged:
            same = counted(merged, "vertex has", "vertices have")
            cure = f"{same} the position of one of another component: merge them with {_CURE}"
        raise InputError(
            who,
            f"the mesh has {len(sizes)} components ({_indices(sizes[:5])}{more} tets), "
            f"one is needed: {cure}",
        )


def _indices(values: NDArray[np.signedinteger]) -> str:
    return ", ".join(str(value) for value in values)
