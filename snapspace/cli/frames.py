"""The output of a path's frames: a folder of numbered files, or a film."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import click

from ..extras import need_extra
from ..mesh.input_path import writable_path
from .console import notice
from .files import ANIMATIONS, FILMS, SURFACE_OUTPUTS, TET_OUTPUTS, make_folder

Command = TypeVar("Command", bound=Callable[..., object])

FORMATS = tuple(
    suffix.removeprefix(".") for suffix in (*SURFACE_OUTPUTS, ".glb", ".gltf", *TET_OUTPUTS)
)


def frame_options(*, files: str, rate: str) -> Callable[[Command], Command]:
    """Adds --format and --fps; `files` and `rate` complete their help texts."""

    def add(command: Command) -> Command:
        command = click.option(
            "--fps",
            "frames_per_second",
            type=click.FloatRange(1, 100),
            help=f"Frames per second of {rate} [default: 30].",
        )(command)
        return click.option(
            "--format",
            "kind",
            type=click.Choice(FORMATS),
            help=f"Format of the files in {files} [default: that of the surface that the model was "
            "made from, or obj].",
        )(command)

    return add


#: The same of commands with --path.
path_options = frame_options(files="the folder of --path", rate="a film of --path")


def is_film(output: Path | None) -> bool:
    """Whether an output is one file for all frames, by its extension."""
    return output is not None and output.suffix.lower() in ANIMATIONS


def check_frames_output(
    output: Path | None, *, kind: str | None, frames_per_second: float | None
) -> None:
    """Creates the folder; ValueError unless frames can be written, before any is solved."""
    film = is_film(output)
    if kind is not None and film:
        raise ValueError(f"--format {kind} is for files in a folder, but -o {output} is a film")
    if frames_per_second is not None and not film:
        raise ValueError("--fps is for a film; give -o FILE.gif, FILE.mp4 or FILE.glb")
    if output is None:
        return
    if film:
        writable_path(output, known=ANIMATIONS)
        if output.suffix.lower() in FILMS:
            need_extra("pictures", who=f"-o {output}")
        if output.suffix.lower() == ".mp4":
            need_extra("video", who=f"-o {output}")
    else:
        _check_folder(output)
        make_folder(output, option="-o")


def _check_folder(output: Path) -> None:
    """Raises ValueError for a name with an extension, unless it is an existing folder."""
    if output.suffix and not output.is_dir():
        raise ValueError(
            f"{output}: frames go to a film ({', '.join(ANIMATIONS)}) or to a folder; give a name "
            "without an extension for a new folder"
        )


def notice_old_frames(folder: Path, frames: int, *, suffix: str) -> None:
    """Prints a notice if frames of an earlier path remain: of a longer one, or in other formats."""
    found = [path for path in folder.glob("frame-*.*") if _number(path) >= 0]
    longer = [path for path in found if path.suffix == suffix and _number(path) >= frames]
    if longer:
        notice(f"notice: {folder} also holds {len(longer)} files of a longer path; delete them")
    series = [path for path in folder.glob("frames.*.series") if suffix not in path.suffixes]
    others = sorted(path for path in (*found, *series) if suffix not in path.suffixes)
    if others:
        notice(
            f"notice: {folder} also holds {len(others)} files of an earlier path in another "
            f"format, such as {others[0].name}; delete them"
        )


def _number(frame: Path) -> int:
    digits = frame.stem.removesuffix("-linear").removeprefix("frame-")
    return int(digits) if digits.isdecimal() else -1
