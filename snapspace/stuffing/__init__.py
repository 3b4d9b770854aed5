"""Isosurface stuffing: tets for the inside of an implicit surface."""

from .isosurface_stuffing import stuff

__all__ = ["stuff"]
