"""Cubature: elastic energies in reduced coordinates, summed over a few tets."""

from .blended_cubature import BlendedCubature
from .blended_elements import WeightedCubature
from .blended_stars import BlendedStars
from .blended_sum import BlendedSum, blended_sum
from .cubature import Cubature
from .elements import element_count, has_hinges, has_stars
from .fit_tets import FEWEST_SNAPSHOTS
from .held_out_errors import CubatureErrors
from .local_rows import LocalRows
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
    "BlendedStars",
    "BlendedSum",
    "Cubature",
    "CubatureErrors",
    "LocalRows",
    "WeightedCubature",
    "blended_sum",
    "default_blended_tets",
    "default_tets",
    "element_count",
    "has_hinges",
    "has_stars",
    "train_blended_cubature",
    "train_cubature",
]
