"""Filling a closed surface with tets."""

from .fill_surface import fill_surface
from .stuff_surface import stuff_surface

__all__ = ["fill_surface", "stuff_surface"]
