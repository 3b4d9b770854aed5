"""Filling a closed surface with tets."""

from .fill_surface import fill_surface

__all__ = ["fill_surface"]
