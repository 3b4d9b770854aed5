"""Affine subspaces of shapes, and the best one for given snapshots (paper, sec. 5)."""

from .affine_subspace import AffineSubspace
from .pca import pca, snapshot_pca

__all__ = ["AffineSubspace", "pca", "snapshot_pca"]
