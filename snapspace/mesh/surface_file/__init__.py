"""Surface files that are written back with new positions and nothing else changed."""

from .surface_file import SurfaceFile, open_surface

__all__ = ["SurfaceFile", "open_surface"]
