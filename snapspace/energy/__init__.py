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

__all__ = [
    "MEMBRANES",
    "Bending",
    "ElasticEnergy",
    "ShellMaterial",
    "element_material",
    "rigidities",
    "shell_materials",
]
