"""Affine subspaces of shapes, such as the best one for given snapshots (paper, sec. 5)."""

from .affine_subspace import AffineSubspace, check_subspace
from .directions import affine_subspace
from .handle_windows import handle_windows
from .pca import pca, snapshot_pca, spanned_dimension
from .rigid_frames import RigidFrames
from .widen import widen

__all__ = [
    "AffineSubspace",
    "RigidFrames",
    "affine_subspace",
    "check_subspace",
    "handle_windows",
    "pca",
    "snapshot_pca",
    "spanned_dimension",
    "widen",
]
