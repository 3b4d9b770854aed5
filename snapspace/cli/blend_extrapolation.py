"""Notices of `snapspace blend` about weights far outside the poses."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..reduction import InterpolationModel
from .blend_shape import BlendedShape
from .console import notice

FloatArray = NDArray[np.float64]


def notice_uncertain(model: InterpolationModel, shape: BlendedShape) -> None:
    """Prints a notice if the energy may have no minimum where the shape was found."""
    if shape.certain is False:  # None means unknown
        notice(
            f"notice: {weights_text(shape.weights)}: the energy need not have a minimum there, and "
            f"the shape may be poor{certain_share(model, shape.weights)}"
        )


def certain_share(model: InterpolationModel, weights: FloatArray) -> str:
    """The end of a message: how far from equal weights there certainly is a minimum."""
    certain = model.certain_range
    share = np.inf if certain is None else certain.reach(weights)
    if share >= 1.0:  # the range does not explain it
        return ""
    return f"; up to {100 * share:.3g} % of the way from equal weights it certainly has one"


def weights_text(weights: FloatArray) -> str:
    """Weights as an option of the command line."""
    return f"--weights {','.join(f'{w:g}' for w in weights)}"
