"""Isosurface stuffing: fills the inside of an implicit surface with tets."""

from .isosurface_stuffing import stuff

__all__ = ["stuff"]
