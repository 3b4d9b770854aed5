"""Displacements of many shapes: rows in memory or files, inner products, orthonormalisation."""

from .displacement_rows import BLOCK, DisplacementRows, shared_mass
from .orthonormal import orthonormalise
from .snapshot_gram import SnapshotGram

__all__ = ["BLOCK", "DisplacementRows", "SnapshotGram", "orthonormalise", "shared_mass"]
