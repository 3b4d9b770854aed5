"""Elastic energies."""

from .elastic_energy import ElasticEnergy

__all__ = ["ElasticEnergy"]
