"""Rival subspaces: each module makes an `AffineSubspace` of a problem in another way."""

from .biharmonic_coordinates import biharmonic_coordinates, biharmonic_subspace
from .farthest_points import farthest_points
from .linear_response import response_subspace
from .modal_derivatives import modal_derivatives, modal_subspace
from .radial_basis import radial_basis_subspace
from .skinning_modes import skinning_subspace
from .vibration_modes import Vibrations, vibration_subspace, vibrations

__all__ = [
    "Vibrations",
    "biharmonic_coordinates",
    "biharmonic_subspace",
    "farthest_points",
    "modal_derivatives",
    "modal_subspace",
    "radial_basis_subspace",
    "response_subspace",
    "skinning_subspace",
    "vibration_subspace",
    "vibrations",
]
