"""uploaded_body: the body in a file that was dropped on a page."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

from ..model_file import SUFFIX, load
from .bodies import mesh_body, model_body
from .body import Body
from .opening import Opening
from .settings import ServerSettings


def uploaded_body(path: Path, opening: Opening, settings: ServerSettings) -> Body:
    """The body in an uploaded mesh or model file, whose folder is removed once it is read.

    ValueError as for `mesh_body` and `load`, with the name of the file only.
    """
    try:
        if path.suffix.lower() == SUFFIX:
            opening.stage("reading")
            return model_body(load(path), name=path.stem, folder=settings.folder)
        body = mesh_body(
            path,
            stage=opening.stage,
            filling=settings.filling,
            read=lambda it: opening.read(replace(it, path=None, folder=settings.folder)),
        )
    except ValueError as error:
        raise ValueError(str(error).replace(str(path), path.name)) from None
    finally:
        shutil.rmtree(path.parent, ignore_errors=True)
    return replace(body, file=None, surface_file=None, folder=settings.folder)
