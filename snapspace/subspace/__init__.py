"""Affine subspaces of shapes, including the best one for given snapshots (paper, sec. 5)."""

from .affine_subspace import AffineSubspace
from .directions import affine_subspace
from .pca import pca, snapshot_pca, spanned_dimension
from .rigid_frames import RigidFrames

__all__ = [
    "AffineSubspace",
    "RigidFrames",
    "affine_subspace",
    "pca",
    "snapshot_pca",
    "spanned_dimension",
]
