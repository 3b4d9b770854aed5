"""Surface files that are written again with new positions and nothing else changed."""

from .appearance import Appearance, SurfaceMaterial
from .surface_file import SurfaceFile, open_surface

__all__ = ["Appearance", "SurfaceFile", "SurfaceMaterial", "open_surface"]
