"""Options of commands that fill surfaces with tets."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

import click

from ..doctor.holes import is_sheet
from ..extras import need_extra
from ..filling import SurfaceFilling
from ..filling.surface_filling import EXACTLY
from ..mesh import TetMesh
from ..mesh.arrays import FloatArray, IndexArray
from .console import notice
from .progress import spinner

Command = TypeVar("Command", bound=Callable[..., Any])
_AS_SHELL = "give --shell THICKNESS, which makes it a shell"


def filling_options(command: Command) -> Command:
    """Adds --edge-length and --exact."""
    for option in (
        click.option(
            "--exact",
            is_flag=True,
            help="Fill surfaces with fTetWild, which keeps sharp edges but takes up to a few "
            "minutes instead of seconds.",
        ),
        click.option(
            "--edge-length",
            type=click.FloatRange(min=0, max=0.5, min_open=True),
            metavar="SHARE",
            help="Edge length of the tets that fill a surface, relative to its diagonal "
            "[default: 0.025, with --exact 0.02].",
        ),
    ):
        command = option(command)
    return command


def check_installed(filling: SurfaceFilling) -> None:
    """ValueError if fTetWild is requested but not installed."""
    if filling.exact:
        need_extra("fill", who="--exact")


def check_unfilled(filling: SurfaceFilling, why: str) -> None:
    """ValueError if the user chose how a surface is filled, but no surface is filled."""
    if filling != SurfaceFilling():
        word = "--exact" if filling.exact else "--edge-length"
        raise ValueError(f"{word} is for filling a surface with tets, but {why}; leave it out")


def filled(
    name: str, vertices: FloatArray, faces: IndexArray, filling: SurfaceFilling
) -> tuple[TetMesh, bool]:
    """The tets inside a surface, and whether they are fTetWild's, which differ in each run."""
    check_installed(filling)
    stages: set[str] = set()

    def begun(stage: str, *_: int) -> None:
        if stage == EXACTLY and stage not in stages and not filling.exact:
            if is_sheet(vertices, faces):
                why = "is open; fTetWild guesses its inside, in up to some minutes (a sheet such "
                why += f"as cloth has none: {_AS_SHELL})"
            else:
                why = "has parts or gaps too thin for quick tets of this size; fTetWild fills it, "
                why += "in up to some minutes (a shorter --edge-length may be faster)"
            notice(f"notice: {name} {why}")
        stages.add(stage)

    with spinner(f"filling {name} with tets"):
        try:
            with naming_shells(vertices, faces):
                tets = filling.fill(vertices, faces, stage=begun)
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from None
    return tets, EXACTLY in stages


@contextmanager
def naming_shells(vertices: FloatArray, faces: IndexArray) -> Iterator[None]:
    """Adds to an error of filling that an open surface can be a shell."""
    try:
        yield
    except ValueError as error:
        if not is_sheet(vertices, faces):
            raise
        raise ValueError(f"{error}; or, for a sheet such as cloth, {_AS_SHELL}") from None
