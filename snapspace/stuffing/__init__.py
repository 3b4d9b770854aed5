"""Isosurface stuffing: fills the inside of an implicit surface with tets."""

from .graded_stuffing import GradedStuffing
from .isosurface_stuffing import Progress, stuff

__all__ = ["GradedStuffing", "Progress", "stuff"]
