"""`snapspace validate`: how far a model is from the full problem."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click
from rich import box
from rich.table import Table

from ..validation import Validation
from ..validation import validate as compare
from .console import console, notice, print_json
from .loading import load_leading
from .options import FILE, json_option, leading_option, threads_option
from .progress import sample_progress

_ROWS = {
    "error": "error",
    "projection_error": "projection error",
    "energy_ratio": "energy, reduced / full",
    "iterations": "iterations",
    "solve_ms": "solve, ms",
    "frame_ms": "frame, ms",
}


@click.command(short_help="Measure the error of a model.")
@click.argument("model_file", type=FILE, metavar="M.snapspace")
@click.option(
    "--samples",
    type=click.IntRange(min=1),
    default=30,
    show_default=True,
    help="Unseen parameters to compare at.",
)
@click.option(
    "--seed",
    type=click.IntRange(min=0),
    default=1,
    show_default=True,
    help="Of the unseen parameters, which no seed of build ever draws.",
)
@leading_option
@threads_option
@json_option
def validate(
    model_file: Path,
    samples: int,
    seed: int,
    dimension: int | None,
    threads: int | None,
    as_json: bool,
) -> None:
    """Compare a model with tightly converged full solutions at parameters that it has not seen.

    \b
    Errors are relative, in the mass norm: |reduced - full| / |full - rest|. The projection error is
    the least that the subspace allows. A frame is a solve from rest and all vertices.

    \b
    Examples:
      snapspace validate dragon.snapspace --samples 30 --seed 1
      snapspace validate dragon.snapspace --dimension 20 --json > error20.json
    """
    model = load_leading(model_file, dimension)
    with sample_progress("full solutions", total=samples) as progress:
        validation = compare(model, samples=samples, seed=seed, threads=threads, progress=progress)
    print_validation(validation, model.dimension, asked=samples)
    if as_json:
        print_json(validation.as_json(model.dimension))


def print_validation(validation: Validation, dimension: int, *, asked: int) -> None:
    """The figures as a table on standard error."""
    figures: dict[str, Any] = validation.as_json(dimension)
    used = figures["samples"]
    table = Table(
        title=f"{used} unseen samples, dimension {dimension}",
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("")
    for name in ("mean", "median", "std", "max"):
        table.add_column(name, justify="right")
    for key, label in _ROWS.items():
        values = figures[key]
        cells = (values.get(name) for name in ("mean", "median", "std", "max"))
        table.add_row(label, *("" if value is None else f"{value:.3g}" for value in cells))
    console().print(table)
    if used < asked:
        notice(
            f"notice: {asked - used} of {asked} full solutions did not converge and are left out"
        )
