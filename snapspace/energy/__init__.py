"""Elastic energies."""

from .elastic_energy import ElasticEnergy
from .shell_material import (
    MEMBRANES,
    Bending,
    ShellMaterial,
    element_material,
    rigidities,
    shell_materials,
)
from .vertex_stars import VertexStars

__all__ = [
    "MEMBRANES",
    "Bending",
    "ElasticEnergy",
    "ShellMaterial",
    "VertexStars",
    "element_material",
    "rigidities",
    "shell_materials",
]
