"""Cubature: elastic energies in reduced coordinates, summed over a few tets."""

from .blended_cubature import BlendedCubature, WeightedCubature
from .cubature import Cubature
from .elements import element_count, has_hinges
from .fit_tets import FEWEST_SNAPSHOTS
from .held_out_errors import CubatureErrors
from .train import (
    FEWEST_BLENDS,
    default_blended_tets,
    default_tets,
    train_blended_cubature,
    train_cubature,
)

__all__ = [
    "FEWEST_BLENDS",
    "FEWEST_SNAPSHOTS",
    "BlendedCubature",
    "Cubature",
    "CubatureErrors",
    "WeightedCubature",
    "default_blended_tets",
    "default_tets",
    "element_count",
    "has_hinges",
    "train_blended_cubature",
    "train_cubature",
]
