"""Groups of the parts of a surface that may belong to one solid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh import compact_surface
from ..mesh.arrays import FloatArray, IndexArray
from ..mesh.box_tree import BoxTree
from ..mesh.closed_surface import enclosed_volume
from ..mesh.edges import edges_of
from ..mesh.signed_distance import SignedDistance
from .components import Labels, connected, face_components

Pairs = NDArray[np.intp]

# Parts nearer than this share of the diagonal may become one solid: fTetWild's usual tolerance.
_NEAR = 5e-4


def parts_apart(vertices: FloatArray, faces: IndexArray) -> tuple[Labels, FloatArray]:
    """Groups components that may belong to one solid; different groups are certainly apart.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    faces : ndarray of int, (f, 3), f > 0

    Returns
    -------
    group : ndarray of int, (f,)
        The group of each face, the largest first.
    share : ndarray, (g,)
        The share of each group in the volume of a closed surface, or in the area of another one.

    Notes
    -----
    Components of a closed surface are in one group if the bounding boxes of two of their faces are
    near each other, or if one of them is inside another. Components of other surfaces, whose
    inside is not clear, are in one group if their own bounding boxes are near each other.
    """
    component = face_components(faces, len(vertices))
    if not component.any():
        return component, np.ones(1)
    corners = vertices[faces]
    closed = not edges_of(faces).balance.any()
    low, high = corners.min(axis=1), corners.max(axis=1)
    reach = 0.5 * _NEAR * float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
    low, high = low - reach, high + reach
    boxes = _boxes_of_each(component, low, high)
    pairs = _touching(*boxes)
    if closed and pairs.size:
        nested = _nested(vertices, faces, component, _box_in_box(*boxes, pairs))
        pairs = np.concatenate([component[_touching(low, high)], nested], axis=1)
    rows, columns = pairs
    group = connected(rows, columns, int(component.max()) + 1)[component]
    size = _sizes(corners, group, closed=closed)
    rank = np.argsort(-size, kind="stable")
    number = np.empty(len(rank), np.intp)
    number[rank] = np.arange(len(rank))
    return number[group], size[rank] / (size.sum() or 1.0)


def _sizes(corners: FloatArray, group: Labels, *, closed: bool) -> FloatArray:
    """Multiples of the volumes of the groups (g,), or of their areas if they are not closed."""
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    if closed:
        weights = np.einsum("ij,ij->i", corners[:, 0] - corners[0, 0], sides)
    else:
        weights = np.linalg.norm(sides, axis=1)
    sizes: FloatArray = np.abs(np.bincount(group, weights=weights))
    return sizes


def _boxes_of_each(
    component: Labels, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Bounding boxes of the components (c, 3), from those of the faces (f, 3)."""
    order = np.argsort(component, kind="stable")
    starts = np.flatnonzero(np.diff(component[order], prepend=-1))
    return np.minimum.reduceat(low[order], starts), np.maximum.reduceat(high[order], starts)


def _touching(low: FloatArray, high: FloatArray) -> Pairs:
    """Pairs of boxes (2, k) that overlap or touch."""
    found = [np.stack(pair) for pair in BoxTree(low, high).overlapping()]
    return np.concatenate([np.empty((2, 0), np.intp), *found], axis=1)


def _box_in_box(low: FloatArray, high: FloatArray, pairs: Pairs) -> Pairs:
    """Those pairs (2, k) of boxes, in both orders, whose second box is in the first."""
    outer, inner = both = np.concatenate([pairs, pairs[::-1]], axis=1)
    within = (low[outer] <= low[inner]) & (high[inner] <= high[outer])
    return both[:, within.all(axis=1)]


def _nested(vertices: FloatArray, faces: IndexArray, component: Labels, pairs: Pairs) -> Pairs:
    """Those pairs of components (2, k) of a closed surface whose second one is inside the first.

    A component in the cavity of another one is outside: the cavity's wall is a component, too, and
    the two cancel in the winding number.
    """
    outer, inner = pairs
    start = vertices[faces[np.unique(component, return_index=True)[1], 0]]
    winding = np.zeros(len(start), np.intp)
    inside = np.zeros(len(outer), np.bool_)
    for part in np.unique(outer):
        points, triangles = compact_surface(vertices, faces[component == part])
        tested = np.flatnonzero(outer == part)
        sign = 1 if enclosed_volume(points, triangles) > 0 else -1
        inside[tested] = sign * SignedDistance(points, triangles)(start[inner[tested]]) < 0
        winding[inner[tested[inside[tested]]]] += sign
    inside &= winding[inner] != 0
    return np.stack([outer[inside], inner[inside]])
