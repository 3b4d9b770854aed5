"""mirrored_region: the part of a body that is the mirror image of another."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from ..mesh import MirrorPlane, check_plane, compact_surface
from ..mesh.arrays import as_indices, as_points
from ..mesh.closest_corners import closest_corners
from ..mesh.validation import check_indices

FloatArray = NDArray[np.float64]
Indices = NDArray[np.int32]


def mirrored_region(
    vertices: FloatArray, faces: Indices, region: ArrayLike, plane: MirrorPlane
) -> Indices:
    """The vertices near the mirror image of a region.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    faces : ndarray of int, (f, 3)
        The surface. Vertices without a face are inside.
    region : array_like of int
        Indices of vertices, at least one.
    plane : MirrorPlane

    Returns
    -------
    ndarray of int32
        Sorted indices. A vertex of the surface is one of them if the surface at its mirror image
        belongs to the region: the corner next to the closest point decides, so that the two sides
        may have different triangles. For a vertex inside, the vertex closest to its mirror image
        decides. If the region is smaller than the triangles of the other side, the result is the
        corners closest to its mirror image. Where vertices are mirror images of each other,
        mirroring twice gives the region itself.

    Raises
    ------
    ValueError
        For a region without vertices, an index out of range, arrays of another shape, or something
        other than a plane.
    """
    who = "mirrored_region"
    check_plane(plane, who)
    vertices = as_points(vertices, who=who)
    faces = as_indices(faces, corners=3, who=who, what="faces")
    check_indices(faces, len(vertices), who=who, what="face")
    chosen = _mask(region, len(vertices))
    shown = np.unique(faces)
    inner = np.setdiff1d(np.arange(len(vertices)), shown)
    surface = compact_surface(vertices, faces)

    found = np.zeros_like(chosen)
    found[shown] = chosen[shown[closest_corners(*surface, plane.points(vertices[shown]))]]
    if inner.size:
        _, nearest = cKDTree(vertices).query(plane.points(vertices[inner]))
        found[inner] = chosen[nearest]
    if not found.any():
        images = plane.points(vertices[np.flatnonzero(chosen)])
        found[shown[closest_corners(*surface, images)]] = True
    return np.flatnonzero(found).astype(np.int32)


def _mask(region: ArrayLike, count: int) -> NDArray[np.bool_]:
    indices = np.asarray(region)
    if not indices.size or indices.dtype.kind not in "iu":
        raise ValueError("mirrored_region: the region needs at least one vertex index")
    wrong = indices[(indices < 0) | (indices >= count)]
    if wrong.size:
        raise ValueError(
            f"mirrored_region: the region has vertex index {wrong[0]}, but there are {count} "
            "vertices"
        )
    mask = np.zeros(count, np.bool_)
    mask[indices] = True
    return mask
