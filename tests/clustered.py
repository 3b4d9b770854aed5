"""Cubatures whose tets share local coordinates."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from snapspace import InterpolationModel, PosingModel
from snapspace.cubature import LocalRows

#: Tets of a cluster; the last one has what is left.
TETS = 24


def local_rows(rows: NDArray[np.float32], rank: int) -> LocalRows:
    """Consecutive tets in clusters, with the `rank` leading singular vectors of their rows.

    The first cluster has one local coordinate less.
    """
    sizes, maps, modes = [], [], []
    for first in range(0, len(rows), TETS):
        own = rows[first : first + TETS].astype(np.float64)
        left, values, right = np.linalg.svd(own.reshape(9 * len(own), -1), full_matrices=False)
        kept = min(rank - (first == 0), len(values))
        sizes.append((len(own), kept))
        maps.append((left[:, :kept] * values[:kept]).astype(np.float32).reshape(-1))
        modes.append(right[:kept].astype(np.float32))
    return LocalRows(np.array(sizes, np.int32), np.concatenate(maps), np.concatenate(modes))


def clustered_model(model: PosingModel, rank: int) -> PosingModel:
    """The model with its tets in clusters."""
    elastic = model.cubature
    assert elastic is not None
    order = np.arange(len(elastic.tets))
    rows = local_rows(elastic.rows, rank)
    return replace(model, elastic=elastic.in_clusters(order, rows))


def clustered_blends(model: InterpolationModel, rank: int) -> InterpolationModel:
    """The same for a model of several poses."""
    blends = model.blends
    order = np.arange(len(blends.tets))
    return replace(model, blends=blends.in_clusters(order, local_rows(blends.rows, rank)))
