"""Charts of evaluations: the error added against microseconds."""

from __future__ import annotations

from itertools import groupby
from pathlib import Path

import numpy as np

from snapspace.pictures import Curve, chart, save_png

from .orderings import Rows
from .result import slug

EXACT = "exact quartic"
NAMES = ("cubature", "coarse mesh", "rotation clusters", EXACT)
#: Where an evaluation without an error is drawn.
LEAST = 1e-5


def draw(rows: Rows, folder: Path) -> None:
    """Writes evaluations_SHAPE.png, one chart for each material at the largest dimension."""
    for shape, group in groupby(rows, lambda row: row["shape"]):
        listed = list(group)
        largest = max(row["d"] for row in listed)
        kept = [row for row in listed if row["d"] == largest]
        charts = [
            _chart(f"{shape}, {material}, d = {largest}", list(part))
            for material, part in groupby(kept, lambda row: row["material"])
        ]
        save_png(folder / f"evaluations_{slug(shape)}.png", np.hstack(charts))


def _chart(title: str, rows: Rows) -> np.ndarray:
    curves = []
    for name in NAMES:
        found = sorted(
            (row for row in rows if row["evaluation"] == name), key=lambda row: row["us"]
        )
        if found:
            curves.append(
                Curve(
                    f"{name}, no error" if name == EXACT else name,
                    [row["us"] for row in found],
                    [max(row["median"], LEAST) for row in found],
                    [str(row["elements"]) for row in found],
                )
            )
    picture: np.ndarray = chart(
        curves,
        title=title,
        x_name="microseconds of value and gradient",
        y_name="median error added",
    )
    return picture
