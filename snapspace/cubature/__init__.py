"""Cubature: elastic energies in reduced coordinates, summed over few tets."""

from .cubature import Cubature
from .held_out_errors import CubatureErrors
from .train import FEWEST_SNAPSHOTS, default_tets, train_cubature

__all__ = ["FEWEST_SNAPSHOTS", "Cubature", "CubatureErrors", "default_tets", "train_cubature"]
