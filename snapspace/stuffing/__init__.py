"""Isosurface stuffing: fills the inside of an implicit surface with tets."""

from .isosurface_stuffing import Progress, stuff

__all__ = ["Progress", "stuff"]
