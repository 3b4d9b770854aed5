"""Tables of errors on standard error."""

from __future__ import annotations

from typing import Any

import numpy as np
from rich import box
from rich.table import Table

from ..validation import PARTS, ErrorCurve, ErrorSplit, Validation
from .console import notice, print_table

_STATISTICS = {"mean": "mean", "median": "median", "ninth": "90 %", "std": "std", "max": "max"}
_ROWS = {
    "error": "error",
    "projection_error": "projection error",
    "energy_ratio": "energy, reduced / full",
    "iterations": "iterations",
    "solve_ms": "solve, ms",
    "frame_ms": "frame, ms",
}
_PARTS = {
    "subspace": "subspace: shapes that it cannot represent",
    "stiffness": "stiffness: it cannot relax as the full mesh does",
    "cubature": "cubature: the energy of only a few tets",
    "minimum": "minimum: frames are at another one",
}


def print_validation(validation: Validation, dimension: int, *, asked: int) -> None:
    """Prints the numbers of a validation, and a notice if samples did not converge."""
    figures: dict[str, Any] = validation.as_json(dimension)
    used = figures["samples"]
    table = _table(f"{used} unseen samples, dimension {dimension}", ["", *_STATISTICS.values()])
    for key, label in _ROWS.items():
        cells = (figures[key].get(name) for name in _STATISTICS)
        table.add_row(label, *("" if value is None else f"{value:.3g}" for value in cells))
    inverted = figures["inverted_tets"]
    if inverted is not None:  # a shell has no tets
        table.add_row("inverted tets", "", "", "", "", str(inverted["frames_max"]))
        table.add_row("inverted tets, full", "", "", "", "", str(inverted["samples_max"]))
    print_table(table)
    if used < asked:
        notice(
            f"notice: {asked - used} of {asked} full solutions did not converge and are left out"
        )


def print_split(split: ErrorSplit) -> None:
    """Prints the parts of the error."""
    table = _table(f"parts of the error, {len(split.error)} unseen samples", ["", "median", "max"])
    rows = [(_PARTS[name], getattr(split, name)) for name in PARTS]
    rows += [("error with all tets", split.error_of_all_tets), ("error", split.error)]
    for label, values in rows:
        table.add_row(label, f"{np.median(values):.3g}", f"{values.max():.3g}")
    print_table(table)


def print_curve(curve: ErrorCurve) -> None:
    """Prints errors and times by dimension."""
    title = f"errors by dimension, {len(curve.reference)} unseen samples"
    table = _table(title, ["d", "median", "90 %", "projection", "solve, ms"])
    for dimension, found in zip(curve.dimensions, curve.validations, strict=True):
        table.add_row(
            str(dimension),
            f"{np.median(found.error):.3g}",
            f"{np.quantile(found.error, 0.9):.3g}",
            f"{np.median(found.projection_error):.3g}",
            f"{np.median(found.solve_ms):.3g}",
        )
    print_table(table)


def _table(title: str, columns: list[str]) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    for number, name in enumerate(columns):
        table.add_column(name, justify="right" if number or name else "left")
    return table
