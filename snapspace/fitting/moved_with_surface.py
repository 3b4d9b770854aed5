"""A first guess of a fitted shape: each vertex moves rigidly with the surface near it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

FloatArray = NDArray[np.float64]

#: Number of faces whose motion a vertex follows.
NEAREST = 12


def moved_with_surface(
    points: FloatArray, rest: FloatArray, target: FloatArray, faces: NDArray[np.integer]
) -> FloatArray:
    """Points after the rigid motions that fit the nearest faces best.

    Parameters
    ----------
    points : ndarray, (n, 3)
        In or near the surface at rest.
    rest, target : ndarray, (s, 3)
        The surface before and after the motion.
    faces : ndarray of int, (f, 3)

    Returns
    -------
    ndarray, (n, 3)
        Tets between these points may be inverted.
    """
    before, after = (x[faces].mean(axis=1) for x in (rest, target))
    gradients = np.einsum("fic,fjc->fij", _frames(target[faces]), _frames(rest[faces]))
    tree = KDTree(before)
    # a list of ranks gives one column for each, even for a single face
    distances, nearest = tree.query(points, k=range(1, min(NEAREST, len(faces)) + 1))
    # a vertex at a center follows this face alone; the diagonal keeps its weight finite
    least = 1e-6 * float(np.linalg.norm(np.ptp(rest, axis=0)))
    weights: FloatArray = 1.0 / (np.asarray(distances) ** 2 + least**2)
    weights /= weights.sum(axis=1, keepdims=True)
    sums = np.einsum("vk,vkij->vij", weights, gradients[nearest])
    left, _, right = np.linalg.svd(sums)
    left[:, :, 2] *= np.linalg.det(left @ right)[:, None]  # a rotation, not a reflection
    center, moved = (np.einsum("vk,vki->vi", weights, x[nearest]) for x in (before, after))
    result: FloatArray = moved + np.einsum("vij,vj->vi", left @ right, points - center)
    return result


def _frames(corners: FloatArray) -> FloatArray:
    """Two edges and the normal of faces (f, 3, 3) as columns, all of the length of an edge."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(first, second)
    length = np.sqrt(np.linalg.norm(normal, axis=1, keepdims=True))
    # a face without area has no normal
    normal = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0.0)
    return np.stack([first, second, normal], axis=2)
