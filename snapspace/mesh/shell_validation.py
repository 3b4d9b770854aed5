"""Checks of a shell's triangles; each message names the first offender, the count and the cure."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..input_error import InputError
from .arrays import FloatArray, IndexArray
from .validation import check_indices, check_points

_CURE = (
    "snapspace.mend_surface(vertices, faces, close_holes=False) (command line: snapspace check "
    "FILE --fix OUT)"
)
# 2 area <= _FLAT * (longest edge)^2 counts as zero. An equilateral triangle has 0.87; rounding of
# float64 coordinates gives about 1e-16.
_FLAT = 1e-12


def check_triangles(vertices: FloatArray, triangles: IndexArray, *, who: str) -> FloatArray:
    """Raise ValueError unless the arrays form an oriented manifold surface; return areas, (f,)."""
    if not len(triangles):
        raise InputError(who, "there are no triangles; at least one is needed")
    check_points(vertices, who=who)
    check_indices(triangles, len(vertices), who=who, what="triangle")
    ordered = np.sort(triangles, axis=1)
    _refuse(
        (ordered[:, 1:] == ordered[:, :-1]).any(axis=1),
        triangles,
        f"repeats a vertex: drop with {_CURE}",
        who=who,
    )
    _, first = np.unique(ordered, axis=0, return_index=True)
    duplicate = np.ones(len(triangles), np.bool_)
    duplicate[first] = False
    _refuse(
        duplicate,
        triangles,
        f"has the same three vertices as an earlier one: drop with {_CURE}",
        who=who,
    )
    areas = _checked_areas(vertices, triangles, who=who)
    _check_edges(triangles, who=who)
    unused = np.flatnonzero(np.bincount(triangles.ravel(), minlength=len(vertices)) == 0)
    if unused.size:
        raise InputError(
            who,
            f"vertex {unused[0]} belongs to no triangle; {unused.size} of {len(vertices)} do not: "
            f"drop with {_CURE}",
        )
    return areas


def _checked_areas(vertices: FloatArray, triangles: IndexArray, *, who: str) -> FloatArray:
    corners = vertices[triangles]
    edges = np.roll(corners, -1, axis=1) - corners
    with np.errstate(over="ignore", invalid="ignore"):
        doubled = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
        longest = (edges**2).sum(axis=2).max(axis=1)
    if not (np.isfinite(doubled).all() and np.isfinite(longest).all()):
        raise InputError(
            who,
            f"coordinates up to {np.abs(vertices).max():g} are too large for the areas to be "
            "computed: choose another unit of length",
        )
    _refuse(
        doubled <= _FLAT * longest,
        triangles,
        "has no area: collapse its shortest edge, or turn its longest one, in a mesh editor",
        who=who,
    )
    return np.asarray(0.5 * doubled, dtype=np.float64)


def _check_edges(triangles: IndexArray, *, who: str) -> None:
    first = triangles.astype(np.int64).ravel()
    second = np.roll(triangles, -1, axis=1).astype(np.int64).ravel()
    edges = np.minimum(first, second) << 32 | np.maximum(first, second)
    keys, uses = np.unique(edges, return_counts=True)
    crowded = np.flatnonzero(uses > 2)
    if crowded.size:
        low, high = int(keys[crowded[0]] >> 32), int(keys[crowded[0]] & 0xFFFFFFFF)
        raise InputError(
            who,
            f"the edge between vertices {low} and {high} has {uses[crowded[0]]} triangles; "
            f"{crowded.size} such edges: an edge of a shell has at most two, so delete the inner "
            "triangles, or give each sheet its own vertices, in a mesh editor",
        )
    directed = first << 32 | second
    again = np.ones(len(directed), np.bool_)
    again[np.unique(directed, return_index=True)[1]] = False
    if again.any():
        place = int(np.flatnonzero(again)[0])
        raise InputError(
            who,
            f"triangle {place // 3} runs from vertex {first[place]} to {second[place]} as an "
            f"earlier one does: their orientations contradict each other at {int(again.sum())} "
            f"edges; flip triangles with {_CURE}, unless the surface has only one side",
        )


def _refuse(bad: NDArray[np.bool_], triangles: IndexArray, fault: str, *, who: str) -> None:
    which = np.flatnonzero(bad)
    if which.size:
        corners = ", ".join(map(str, triangles[which[0]]))
        raise InputError(
            who,
            f"triangle {which[0]} ({corners}; {which.size} such of {len(triangles)}) {fault}",
        )
