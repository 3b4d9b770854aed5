"""The picture of an error curve: errors over dimension, and over solve time."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..pictures import Curve, chart, save_png
from ..validation import ErrorCurve

#: Smallest error that is drawn: of the size of rounding errors, since a logarithmic axis has no
#: zero.
LEAST = 1e-16


def save_error_plot(path: Path, curve: ErrorCurve) -> Path:
    """Writes two charts, side by side, as PNG.

    Left: median and 90th percentile of the errors, and the median of the projections, over d.
    Right: the median error over the median milliseconds of a solve from the rest or mean shape.
    """
    dimensions = [float(d) for d in curve.dimensions]
    error, ninth, projection, milliseconds = (
        [max(float(value), LEAST) for value in values]
        for values in zip(
            *(
                (
                    np.median(v.error),
                    np.quantile(v.error, 0.9),
                    np.median(v.projection_error),
                    np.median(v.solve_ms),
                )
                for v in curve.validations
            ),
            strict=True,
        )
    )
    samples = len(curve.reference)
    left = chart(
        [
            Curve("error, 90 %", dimensions, ninth),
            Curve("error, median", dimensions, error),
            Curve("of projections, median", dimensions, projection),
        ],
        title=f"{samples} unseen samples",
        x_name="dimension",
        y_name="relative error",
    )
    right = chart(
        [Curve("error, median", milliseconds, error, [f"d = {d:g}" for d in dimensions])],
        title="cost of accuracy",
        x_name="milliseconds of a solve",
        y_name="relative error",
    )
    return save_png(path, np.hstack([left, right]))
