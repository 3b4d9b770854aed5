"""Reduced energies and models."""

from .cubature import Cubature
from .handle_quadric import HandleQuadric, handle_quadric
from .interpolation_model import InterpolationModel
from .posing_model import PosingModel
from .quartic import Quartic, coefficient_count, pose_quartics, reduced_quartic
from .reduce import reduce
from .reduced_model import ReducedModel

__all__ = [
    "Cubature",
    "HandleQuadric",
    "InterpolationModel",
    "PosingModel",
    "Quartic",
    "ReducedModel",
    "coefficient_count",
    "handle_quadric",
    "pose_quartics",
    "reduce",
    "reduced_quartic",
]
