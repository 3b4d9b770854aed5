"""Reduced energies and models."""

from ..cubature import (
    BlendedCubature,
    BlendedStars,
    BlendedSum,
    Cubature,
    CubatureErrors,
    LocalRows,
    blended_sum,
    default_blended_tets,
    default_tets,
    element_count,
    has_hinges,
    has_stars,
)
from .check_model import check_model
from .energy_choice import (
    ENERGIES,
    STORED_ENERGIES,
    Energy,
    chosen_energy,
    fewest_snapshots,
    training_tolerance,
)
from .full_energy import FullBlends, FullEnergy, not_stored
from .handle_quadric import HandleQuadric, handle_quadric
from .interpolation_model import InterpolationModel
from .posing_model import PosingModel
from .quartic import (
    PoseQuartics,
    Quartic,
    coefficient_count,
    pose_quartics,
    reduced_quartic,
)
from .quartic_cost import LongWorkNotice, exact_seconds
from .reduce import reduce
from .reduced_model import ReducedModel
from .solved_sessions import (
    reduced_solutions,
    solved_coordinates,
    solved_sessions,
    solved_shapes,
)
from .with_handles import with_handles

__all__ = [
    "ENERGIES",
    "STORED_ENERGIES",
    "BlendedCubature",
    "BlendedStars",
    "BlendedSum",
    "Cubature",
    "CubatureErrors",
    "Energy",
    "FullBlends",
    "FullEnergy",
    "HandleQuadric",
    "InterpolationModel",
    "LocalRows",
    "LongWorkNotice",
    "PoseQuartics",
    "PosingModel",
    "Quartic",
    "ReducedModel",
    "blended_sum",
    "check_model",
    "chosen_energy",
    "coefficient_count",
    "default_blended_tets",
    "default_tets",
    "element_count",
    "exact_seconds",
    "fewest_snapshots",
    "handle_quadric",
    "has_hinges",
    "has_stars",
    "not_stored",
    "pose_quartics",
    "reduce",
    "reduced_quartic",
    "reduced_solutions",
    "solved_coordinates",
    "solved_sessions",
    "solved_shapes",
    "training_tolerance",
    "with_handles",
]
