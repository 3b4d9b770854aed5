"""The doctor finds and mends faults of surfaces."""

from .check_surface import SurfaceReport, check_surface
from .finding import Finding
from .mend_surface import MendedSurface, mend_surface

__all__ = ["Finding", "MendedSurface", "SurfaceReport", "check_surface", "mend_surface"]
