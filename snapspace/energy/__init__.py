"""Elastic energies."""

from .elastic_energy import ElasticEnergy
from .pose_energies import PoseEnergies
from .shell_material import (
    SHELLS,
    Bending,
    ShellMaterial,
    element_material,
    is_of_stars,
    rigidities,
)
from .vertex_stars import StarParts, StarTriangles, VertexStars

__all__ = [
    "SHELLS",
    "Bending",
    "ElasticEnergy",
    "PoseEnergies",
    "ShellMaterial",
    "StarParts",
    "StarTriangles",
    "VertexStars",
    "element_material",
    "is_of_stars",
    "rigidities",
]
