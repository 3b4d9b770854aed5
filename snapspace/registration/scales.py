"""Poses of one object that come in different units of length."""

from __future__ import annotations

from itertools import combinations
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_numbers

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.integer]
ScalePolicy = Literal["auto", "match", "keep"]
SCALE_POLICIES: tuple[ScalePolicy, ...] = ("auto", "match", "keep")

#: Ratio of edge lengths, in either direction, beyond which "auto" assumes another unit of
#: length. Posing bends a body far more than it stretches it, and common units differ by larger
#: factors: an inch is 2.54 cm, a yard 3 feet. (Yard and metre, a factor of 1.09, are the
#: exception.)
UNITS_DIFFER_BEYOND = 1.5


def scale_factors(shapes: ArrayLike, cells: ArrayLike) -> FloatArray:
    """Factors that bring poses to the size of the first one.

    Parameters
    ----------
    shapes : array_like, (k, n, 3)
        Poses of one mesh; vertex i corresponds to vertex i.
    cells : array_like of int, (f, 3) or (m, 4)
        The faces or tets of the mesh.

    Returns
    -------
    ndarray, (k,)
        Multiply pose i by factor i. Then the median, over the edges, of length / length in the
        first pose is one. The first factor is 1. Edges of length zero in the first pose are left
        out. The median ignores parts that grow or shrink, if more than half of the edges keep their
        length.

    Raises
    ------
    ValueError
        For wrong array shapes, coordinates that are not finite, an index out of range, or a pose
        in which half of the edges have no length.
    """
    poses = as_numbers("scale_factors", "shapes", shapes)
    if poses.ndim != 3 or poses.shape[2] != 3 or not len(poses):
        raise ValueError(f"scale_factors: shapes must be (k, n, 3), got {poses.shape}")
    if not np.isfinite(poses).all():
        pose, vertex = np.argwhere(~np.isfinite(poses).all(axis=2))[0]
        raise ValueError(f"scale_factors: vertex {vertex} of pose {pose} is not finite")
    first, second = _edges(cells, poses.shape[1])
    lengths = np.linalg.norm(poses[:, first] - poses[:, second], axis=2)
    known = lengths[0] > 0
    if not known.any():
        raise ValueError("scale_factors: all edges of pose 0 have length zero; check its vertices")
    ratios = np.median(lengths[:, known] / lengths[0, known], axis=1)
    if not ratios.all():
        raise ValueError(
            f"scale_factors: half of the edges of pose {np.flatnonzero(ratios == 0)[0]} have "
            "length zero, so its size is unknown; check its vertices"
        )
    return np.asarray(1.0 / ratios, dtype=np.float64)


def matched_scales(
    shapes: ArrayLike, cells: ArrayLike, *, policy: ScalePolicy = "auto"
) -> tuple[FloatArray, FloatArray]:
    """Poses brought to the unit of length of the first one.

    Parameters
    ----------
    shapes, cells : see `scale_factors`
    policy : "auto", "match" or "keep", default "auto"
        Which poses are scaled. "auto": those whose edges are longer or shorter than the first
        pose's by a factor of more than 1.5 (`UNITS_DIFFER_BEYOND`), since poses change size by less
        and units of length by more. "match": all. "keep": none.

    Returns
    -------
    shapes : ndarray, (k, n, 3)
        The poses, each multiplied by its factor (about the origin).
    factors : ndarray, (k,)
        Factors that were applied; exactly 1 for poses that were not scaled.

    Raises
    ------
    ValueError
        For an unknown policy, and as `scale_factors` unless the policy is "keep".
    """
    if policy not in SCALE_POLICIES:
        raise ValueError(
            f"matched_scales: unknown policy '{policy}'; known are {', '.join(SCALE_POLICIES)}"
        )
    poses = as_numbers("matched_scales", "shapes", shapes)
    if policy == "keep":
        return poses.copy(), np.ones(len(poses))
    factors = scale_factors(poses, cells)
    if policy == "auto":
        same_unit = (factors <= UNITS_DIFFER_BEYOND) & (factors >= 1.0 / UNITS_DIFFER_BEYOND)
        factors = np.where(same_unit, 1.0, factors)
    return poses * factors[:, None, None], factors


def _edges(cells: ArrayLike, vertex_count: int) -> tuple[IndexArray, IndexArray]:
    """Both ends of all edges of faces or tets, each edge once."""
    rows = np.asarray(cells)
    if rows.ndim != 2 or rows.shape[1] not in (3, 4) or rows.dtype.kind not in "iu":
        raise ValueError(
            "scale_factors: cells must be faces (f, 3) or tets (m, 4) of integers, got "
            f"{rows.dtype} of shape {rows.shape}"
        )
    if rows.size and not (0 <= rows.min() and rows.max() < vertex_count):
        cell = np.flatnonzero(((rows < 0) | (rows >= vertex_count)).any(axis=1))[0]
        raise ValueError(
            f"scale_factors: cell {cell} ({', '.join(map(str, rows[cell]))}) has an index out of "
            f"range; the shapes have {vertex_count} vertices"
        )
    pairs = np.sort(rows[:, list(combinations(range(rows.shape[1]), 2))].reshape(-1, 2), axis=1)
    keys = np.unique(pairs[:, 0].astype(np.int64) * vertex_count + pairs[:, 1])
    return keys // vertex_count, keys % vertex_count
