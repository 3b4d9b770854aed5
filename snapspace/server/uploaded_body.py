"""read_upload: the body of a file that was dropped on a page."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from ..model_file import SUFFIX, load
from .bodies import model_body, read_mesh
from .body import Body
from .opening import Opening
from .settings import ServerSettings
from .user_surface import UserSurface


def read_upload(path: Path, settings: ServerSettings) -> Callable[[Opening], Body]:
    """Reads an uploaded mesh or model file, and removes its folder.

    Returns
    -------
    callable(Opening) -> Body
        Makes the body, and fills a surface.

    Raises
    ------
    ValueError
        As for `mesh_body` and `load`, with the name of the file only.
    """
    with _named(path):
        try:
            if path.suffix.lower() == SUFFIX:
                own = model_body(load(path), name=path.stem, folder=settings.folder)
                return lambda _: own
            make = read_mesh(path, filling=settings.filling)
        finally:
            shutil.rmtree(path.parent, ignore_errors=True)

    def made(opening: Opening) -> Body:
        def read(surface: UserSurface) -> None:
            opening.read(replace(surface, path=None, folder=settings.folder))

        with _named(path):
            body = make(Opening(opening.stage, read))
        return replace(body, file=None, surface_file=None, folder=settings.folder)

    return made


@contextmanager
def _named(path: Path) -> Iterator[None]:
    """ValueErrors in this block name the file without its folder."""
    try:
        yield
    except ValueError as error:
        raise ValueError(str(error).replace(str(path), path.name)) from None
