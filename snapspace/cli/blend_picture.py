"""The picture of `snapspace blend --png`: shapes in a row, the linear blends below."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..pictures import render_row
from ..reduction import InterpolationModel
from .blend_shape import BlendedShape

MOST = 7  # largest number of shapes of a path that are shown


def blend_picture(
    model: InterpolationModel, shapes: list[BlendedShape], *, up: str
) -> NDArray[np.uint8]:
    """Up to MOST shapes, evenly chosen, all at one scale."""
    chosen = np.unique(np.linspace(0, len(shapes) - 1, min(MOST, len(shapes))).round().astype(int))
    picked = [shapes[number] for number in chosen]
    surfaces = [model.surface.vertices(shape.vertices) for shape in picked]
    straight = [
        model.surface.vertices(shape.linear) for shape in picked if shape.linear is not None
    ]
    labels = [_label(shape.weights) for shape in picked]
    if straight:
        labels += [f"linear {label}" for label in labels]
    return render_row(
        surfaces + straight,
        model.surface.faces,
        labels=labels,
        columns=len(picked),
        up=up,
    )


def _label(weights: NDArray[np.float64]) -> str:
    return " ".join(f"{weight:.2g}" for weight in weights)
