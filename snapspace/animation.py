"""write_animation: the frames of a session as numbered files, GIF, MP4 or animated glTF."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arguments import as_numbers, as_path, require_positive, require_type
from .disk import atomic_file
from .gltf import film_targets, still_shape, write_glb
from .mesh import SURFACE_OUTPUTS, TET_OUTPUTS, EmbeddedSurface, solid_of, write_surface, write_tets
from .reduction import ReducedModel, check_model

#: Formats for ParaView, which come with a list of the files.
_SERIES = (".vtu", ".vtk")
_GLB_OPTIONS = ("frames_per_second", "name", "up", "colors", "targets")


def write_animation(
    path: str | os.PathLike[str],
    model: ReducedModel,
    shapes: Iterable[ArrayLike],
    *,
    kind: str | None = None,
    frames_per_second: float = 30.0,
    **picture: Any,
) -> list[Path]:
    """Writes shapes of a model, for instance the frames of `session.animate`.

    Parameters
    ----------
    path : path
        A film, `.gif` or `.mp4`; an animated mesh, `.glb`; or a folder for frame-0000.obj,
        frame-0001.obj and so on, which is created. Existing files with these names are replaced.
    model : ReducedModel
        The model that the shapes belong to.
    shapes : iterable of (n, 3)
        Vertices of the tets.
    kind : str, default that of the user's surface, or obj
        Format of the files in a folder: a surface as obj, ply, off, stl or glb, or all tets as msh,
        vtu, vtk or mesh. In the format of the file that the surface came from (also gltf), each
        frame is that file with other positions, see `SurfaceFile`. A glb has the file's materials,
        see `write_glb`. Other formats have triangles only. With vtu or vtk, a file such as
        frames.vtu.series opens all frames with their times in ParaView.
    frames_per_second : float, default 30
        The frame rate of a film, a .glb or a series for ParaView.
    **picture
        Options for a film: size, azimuth, elevation, up (default: that of the model), colors and
        others, see `pictures.save_film`. A .glb accepts up, colors and targets: the largest number
        of morph targets that are fitted to the shapes, at least 2, default 8, see `write_glb`. The
        kind glb accepts up.

    Returns
    -------
    list of Path
        The files written: the film, or the files of the frames in order.

    Raises
    ------
    ValueError
        For something other than a model, no shapes, an unknown kind or option, a frame rate that
        is not positive, a folder that cannot be created, and as for `save_film`.

    Examples
    --------
    >>> frames = session.animate([{"head": ((0, 0, 0.6), (0, 0, 0.2))}], frames=48)
    >>> write_animation("nod.gif", session.model, (session.vertices for _ in frames))
    """
    check_model(model, "write_animation", "give path, model, shapes")
    target = as_path("write_animation", path, what="file or folder")
    cure = "give the vertices (n, 3) of each frame"
    require_type("write_animation", "shapes", shapes, Iterable, cure)
    require_positive("write_animation", "frames_per_second", frames_per_second)
    if target.suffix.lower() in (".gif", ".mp4"):
        from .pictures import save_film

        _check_options(target, picture, save_film.__kwdefaults__ or ())
        surface = model.surface
        seen = [surface.vertices(_checked(shape, model)) for shape in shapes]
        rate = frames_per_second
        picture.setdefault("up", model.up)
        return [save_film(target, seen, surface.faces, frames_per_second=rate, **picture)]
    if target.suffix.lower() == ".glb":
        _check_options(target, picture, _GLB_OPTIONS)
        count = picture.pop("targets", 8)
        placed = [_checked(shape, model) for shape in shapes]
        morphs = film_targets(model, placed, count=count)
        rate = frames_per_second
        return [write_glb(target, model, morphs, frames_per_second=rate, **picture)]
    suffix = shape_suffix(model, kind)
    known = ("kind", "frames_per_second", *(("up",) if suffix == ".glb" else ()))
    _check_options(target, picture, known, "; names that end in .gif, .mp4 or .glb take others")
    return _written(target, model, shapes, suffix, frames_per_second, up=picture.get("up"))


def write_shape(
    path: Path, model: ReducedModel, vertices: NDArray[np.float64], *, up: str | None = None
) -> None:
    """Writes a shape (n, 3) of a model: its surface or its tets, depending on the extension.

    In the format of the file that the surface came from, the result is that file with other
    positions. A .glb of another surface has the surface's materials, and its axis `up`, by default
    the model's, points up.
    """
    suffix, surface = path.suffix.lower(), model.surface
    source = surface.source
    if source is not None and suffix == source.suffix:
        source.write(path, surface.vertices(vertices))
    elif suffix == ".glb":
        write_glb(path, model, still_shape(model, vertices), up=up)
    elif suffix in SURFACE_OUTPUTS:
        write_surface(path, surface.vertices(vertices), surface.faces)
    else:
        write_tets(path, solid_of(model.problem.mesh, who=str(path)), vertices=vertices)


def shape_suffixes(surface: EmbeddedSurface) -> tuple[str, ...]:
    """Extensions that `write_shape` accepts for a model with this surface."""
    own = () if surface.source is None else (surface.source.suffix,)
    return tuple(dict.fromkeys((*SURFACE_OUTPUTS, ".glb", *own, *TET_OUTPUTS)))


def shape_suffix(model: ReducedModel, kind: str | None) -> str:
    """The extension of shapes of a kind, by default that of the user's own surface, or .obj."""
    if kind:
        return f".{kind}"
    source = model.surface.source
    return ".obj" if source is None else source.suffix


def _check_options(
    target: Path, given: Iterable[str], known: Iterable[str], others: str = ""
) -> None:
    unknown = ", ".join(name for name in given if name not in known)
    if unknown:
        raise ValueError(
            f"write_animation: unknown option {unknown} for {target}; known are {', '.join(known)}"
            f"{others}"
        )


def _written(
    folder: Path,
    model: ReducedModel,
    shapes: Iterable[ArrayLike],
    suffix: str,
    frames_per_second: float,
    *,
    up: str | None,
) -> list[Path]:
    allowed = shape_suffixes(model.surface)
    if suffix not in allowed:
        known = ", ".join(known.removeprefix(".") for known in allowed)
        raise ValueError(f"write_animation: unknown kind '{suffix[1:]}'; known are {known}")
    if folder.suffix and not folder.is_dir():
        raise ValueError(
            f"write_animation: {folder} is neither a film (.gif, .mp4 or .glb) nor a folder; "
            "give a name without an extension for a new folder"
        )
    frames = iter(shapes)
    first = next(frames, None)
    if first is None:
        raise ValueError("write_animation: there are no shapes; give one for each frame")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ValueError(
            f"write_animation: cannot create the folder {folder} ({error.strerror}); give another"
        ) from None
    files = []
    for number, shape in enumerate(chain([first], frames)):
        vertices = _checked(shape, model)
        file = folder / f"frame-{number:04d}{suffix}"
        write_shape(file, model, vertices, up=up)
        files.append(file)
    if suffix in _SERIES:
        _write_series(folder / f"frames{suffix}.series", files, frames_per_second)
    return files


def _write_series(path: Path, files: Sequence[Path], frames_per_second: float) -> None:
    """The list of files with their times in seconds, which ParaView opens as one."""
    entries = [{"name": f.name, "time": k / frames_per_second} for k, f in enumerate(files)]
    content = {"file-series-version": "1.0", "files": entries}
    with atomic_file(path) as temporary:
        temporary.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def _checked(shape: ArrayLike, model: ReducedModel) -> NDArray[np.float64]:
    vertices = as_numbers("write_animation", "the shapes", shape)
    expected = model.problem.mesh.vertices.shape
    if vertices.shape != expected:
        raise ValueError(
            f"write_animation: a shape is {vertices.shape}, but the model's vertices are {expected}"
        )
    return vertices
