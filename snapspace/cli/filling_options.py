"""Options of commands that fill surfaces with tets."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import click

from ..extras import need_extra
from ..filling import SurfaceFilling
from ..mesh import SurfaceFile, TetMesh
from .progress import spinner

Command = TypeVar("Command", bound=Callable[..., Any])


def filling_options(command: Command) -> Command:
    """Adds --edge-length and --exact."""
    for option in (
        click.option(
            "--exact",
            is_flag=True,
            help="Fill surfaces with fTetWild, which keeps sharp edges but takes minutes, not "
            "seconds.",
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


def filling_of(edge_length: float | None, *, exact: bool) -> SurfaceFilling:
    """How to fill; ValueError if fTetWild is asked for and not installed."""
    if exact:
        need_extra("fill", who="--exact")
    return SurfaceFilling(edge_length=edge_length, exact=exact)


def filled(file: SurfaceFile, filling: SurfaceFilling) -> TetMesh:
    """The tets inside a surface file, with a line on the screen while it is filled."""
    with spinner(f"filling {file.name} with tets"):
        try:
            return filling.fill(file.vertices, file.faces, stage=lambda *_: None)
        except ValueError as error:
            raise ValueError(f"{file.name}: {error}") from None
