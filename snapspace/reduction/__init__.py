"""Reduced energies and models."""

from .handle_quadric import HandleQuadric, handle_quadric
from .quartic import Quartic, coefficient_count, reduced_quartic
from .reduced_model import ReducedModel, reduce

__all__ = [
    "HandleQuadric",
    "Quartic",
    "ReducedModel",
    "coefficient_count",
    "handle_quadric",
    "reduce",
    "reduced_quartic",
]
