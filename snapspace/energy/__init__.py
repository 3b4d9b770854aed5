"""Elastic materials and energies."""

from .elastic_energy import ElasticEnergy
from .material import StVK

__all__ = ["ElasticEnergy", "StVK"]
