"""Affine subspaces of shapes, including the best one for given snapshots (paper, sec. 5)."""

from .affine_subspace import AffineSubspace
from .directions import affine_subspace
from .pca import pca, snapshot_pca

__all__ = ["AffineSubspace", "affine_subspace", "pca", "snapshot_pca"]
