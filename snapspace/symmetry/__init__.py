"""Symmetric bodies: their mirror plane, and mirror images of handles and poses."""

from .counterparts import counterparts
from .mirror_handle import checked_image, mirror_handle
from .model_plane import plane_of
from .plane_search import NotSymmetricError, mirror_plane
from .region import mirrored_region
from .side_names import mirrored_name

__all__ = [
    "NotSymmetricError",
    "checked_image",
    "counterparts",
    "mirror_handle",
    "mirror_plane",
    "mirrored_name",
    "mirrored_region",
    "plane_of",
]
