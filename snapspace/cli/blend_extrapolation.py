"""What `snapspace blend` tells of weights far outside."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..reduction import InterpolationModel
from .blend_shape import BlendedShape
from .console import notice

FloatArray = NDArray[np.float64]


def notice_uncertain(model: InterpolationModel, shape: BlendedShape) -> None:
    """A notice if the shape was found where the energy need not have a minimum."""
    if shape.certain is False:  # of None nothing is known
        notice(
            f"notice: {weights_text(shape.weights)}: the energy need not have a minimum there, and "
            f"the shape may be a poor one{certain_share(model, shape.weights)}"
        )


def certain_share(model: InterpolationModel, weights: FloatArray) -> str:
    """How far on the way from equal weights there is a minimum, to end a message with."""
    certain = model.certain_range
    share = np.inf if certain is None else certain.reach(weights)
    if share >= 1.0:  # not what ended it
        return ""
    return f"; up to {100 * share:.3g} % of the way from equal weights it certainly has one"


def weights_text(weights: FloatArray) -> str:
    """As on the command line."""
    return f"--weights {','.join(f'{w:g}' for w in weights)}"
