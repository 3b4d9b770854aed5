"""own_look: the appearance of a user's file, with notes of what is missing in it."""

from __future__ import annotations

from .appearance import Appearance
from .surface_file import SurfaceFile


def own_look(source: SurfaceFile, notes: list[str], *, without: str) -> Appearance | None:
    """The file's appearance, None if it is damaged or has none.

    Adds notes about damaged or missing parts; `without` says how the surface is shown then.
    """
    try:
        look = source.appearance
    except ValueError as error:
        notes.append(f"{error}; {without}")
        return None
    if look is not None and look.missing:
        names = ", ".join(look.missing[:3]) + (" ..." if len(look.missing) > 3 else "")
        notes.append(
            f"not found beside {source.name}, or no PNG, JPEG, WebP, GIF or BMP: {names}; {without}"
        )
    return look
