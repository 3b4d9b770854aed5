"""Displacements of many shapes: rows in memory or files, inner products, orthonormalisation."""

from .chosen_rows import chosen_rows
from .displacement_rows import BLOCK, DisplacementRows, shared_mass
from .orthonormal import orthonormalise
from .snapshot_gram import SnapshotGram

__all__ = [
    "BLOCK",
    "DisplacementRows",
    "SnapshotGram",
    "chosen_rows",
    "orthonormalise",
    "shared_mass",
]
