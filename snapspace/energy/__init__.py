"""Elastic energies."""

from .elastic_energy import ElasticEnergy
from .shell_material import Bending, ShellMaterial, element_material, rigidities

__all__ = ["Bending", "ElasticEnergy", "ShellMaterial", "element_material", "rigidities"]
