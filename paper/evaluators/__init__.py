"""Rival evaluations of the reduced energy: coarse meshes, and clusters of rotations."""

from .coarse_energy import coarse_full_energy, coarse_model
from .edge_collapse import CoarseMesh, coarse_meshes
from .local_global import LocalGlobal, local_global, nearest_rotations
from .near_newton import NearlyNewton, with_near_hessian
from .rotation_clusters import (
    ClusteredEnergy,
    clustered_energy,
    clustered_model,
    rotation_clusters,
)

__all__ = [
    "ClusteredEnergy",
    "CoarseMesh",
    "LocalGlobal",
    "NearlyNewton",
    "clustered_energy",
    "clustered_model",
    "coarse_full_energy",
    "coarse_meshes",
    "coarse_model",
    "local_global",
    "nearest_rotations",
    "rotation_clusters",
    "with_near_hessian",
]
