"""Filling a closed surface with tets."""

from .fill_surface import fill_surface
from .stuff_surface import stuff_surface
from .surface_filling import SurfaceFilling

__all__ = ["SurfaceFilling", "fill_surface", "stuff_surface"]
