"""file_kind: what a file is, by its extension, for messages about the wrong kind of file."""

from __future__ import annotations

from pathlib import Path

from .read import TET_SUFFIXES
from .read_surface import SURFACE_SUFFIXES

_OTHERS = {".json": "a problem or timeline", ".html": "a page", ".snapspace": "a model"}


def file_kind(path: Path) -> str:
    """For example "a surface"; "a file of another kind" for an unknown extension."""
    suffix = path.suffix.lower()
    if suffix in TET_SUFFIXES:
        return "a tet mesh"
    if suffix in SURFACE_SUFFIXES:
        return "a surface"
    return _OTHERS.get(suffix, "a file of another kind")
