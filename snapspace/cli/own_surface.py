"""Writing shapes into the user's own surface file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import click
import numpy as np

from ..animation import shape_suffix, shape_suffixes
from ..mesh import SurfaceFile, embed_file, open_surface, solid_of
from ..reduction import InterpolationModel, PosingModel, ReducedModel
from .console import notice
from .files import ANIMATIONS, FILMS, SURFACE_INPUTS, TET_OUTPUTS
from .frames import is_film
from .options import FILE

Command = TypeVar("Command", bound=Callable[..., Any])
Model = TypeVar("Model", PosingModel, InterpolationModel)


def surface_option(command: Command) -> Command:
    """Adds --surface, None for the surface in the model."""
    return click.option(
        "--surface",
        "surface_file",
        type=FILE,
        metavar="FILE",
        help="Move this surface instead of the model's own; it is in the unit and frame of the "
        "mesh at rest. In its own format it keeps UVs, polygons, materials and colours.",
    )(command)


def with_surface(model: Model, file: Path | None) -> Model:
    """The model with the surface of --surface, or unchanged.

    ValueError if the file cannot be read, or lies too far from the tets.
    """
    if file is None:
        return model
    source = open_surface(file).compact()
    try:
        # whatever lies near the tets, such as clothes, follows them
        mesh = solid_of(model.problem.mesh, who="--surface")
        return replace(model, surface=embed_file(source, mesh, farthest=0.1))
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def check_own_output(
    model: ReducedModel, output: Path | None, kind: str | None, *, path: bool
) -> None:
    """Says what a format keeps of the user's surface; ValueError for a format that needs a source.

    Parameters
    ----------
    model : ReducedModel
    output : Path or None
        A file or, with `path`, a folder or a film.
    kind : str or None
        The format of --format.
    path : bool
        Whether frames of a path are written.
    """
    if output is None:
        return
    source = model.surface.source
    usual = source.suffix if source is not None else ".obj"
    suffix = _suffix(model, output, kind, path=path)
    if suffix in FILMS:
        return
    if suffix == ".glb":
        _notice_glb(source, whole=path and output.suffix.lower() in ANIMATIONS)
        return
    if suffix not in shape_suffixes(model.surface):
        came = "has no surface file" if source is None else f"has {source.name}"
        raise ValueError(
            f"{output}: a {suffix} file is written only in place of the surface that the model "
            f"was made from, but this one {came}; give --surface FILE{suffix}, or write "
            f"{usual}"
        )
    if source is None or suffix in TET_OUTPUTS:
        return
    if suffix != source.suffix:
        if is_plain(source):
            return
        notice(
            f"notice: a {suffix} file has triangles and positions only; write {source.suffix} to "
            f"keep all that {source.name} has"
        )
        return
    folder = output if path else output.parent
    names = [name for name in source.refers_to if name not in source.beside]
    missing = [name for name in names if not (folder / name).exists()]
    if missing:
        notice(
            f"notice: {source.name} refers to {', '.join(missing)}; copy the file to {folder} too"
        )


def check_up(
    model: ReducedModel, up: str | None, output: Path | None, kind: str | None, *, path: bool
) -> None:
    """ValueError for --up where the output is a file whose coordinates it does not change."""
    if up is None:
        return
    suffix = None if output is None else _suffix(model, output, kind, path=path)
    source = model.surface.source
    own = source is not None and suffix == source.suffix and not (path and is_film(output))
    if own or suffix not in ANIMATIONS:
        raise ValueError(
            "--up is for pictures, films and new .glb files; coordinates in other files stay, so "
            "leave it out"
        )


def _suffix(model: ReducedModel, output: Path, kind: str | None, *, path: bool) -> str:
    """The extension of the written files: of the output, or of the files in it."""
    if path and not is_film(output):
        return shape_suffix(model, kind)
    return output.suffix.lower()


def _notice_glb(source: SurfaceFile | None, *, whole: bool) -> None:
    """Says what a new .glb loses of a glTF file; `whole` if it is an animation."""
    if source is None or source.suffix not in (".glb", ".gltf"):
        return
    if whole or source.suffix == ".gltf":
        notice(
            f"notice: of the materials of {source.name} the .glb file has base colours only, and "
            f"no skins; frames in a folder, as {source.suffix}, keep everything"
        )


def is_plain(source: SurfaceFile) -> bool:
    """Whether a file has triangles and positions only, so that any format keeps all of it."""
    if source.suffix in (".off", ".obj"):
        # a letter or number begins each row, and OFF the file, with three counts: more words are
        # colours, names, comments and others
        head = 4 if source.suffix == ".off" else len(source.vertices)
        words = head + 3 * len(source.vertices) + 4 * len(source.faces)
        only_triangles = bool((np.diff(source.starts) == 3).all())
        return only_triangles and len(source.data.split()) <= words
    return source.suffix == ".stl"


#: Extensions that a shape may be written to; some of them only for some models.
SHAPE_OUTPUTS = tuple(dict.fromkeys((*SURFACE_INPUTS, *TET_OUTPUTS)))
