"""Hyper-reduction: reduced energies summed over few tets."""

from .held_out_errors import CubatureErrors
from .hyper_reduce import hyper_reduce

__all__ = ["CubatureErrors", "hyper_reduce"]
