"""The path of `snapspace blend --path --even weights`: from pose to pose."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def path_weights(poses: int, frames: int) -> NDArray[np.float64]:
    """Weights (frames, poses) from the first pose through all poses to the last, evenly spaced.

    On every leg two weights change linearly and the others are zero. The first and the last frame
    are poses; those between are hit if frames - 1 is a multiple of poses - 1.
    """
    # integers first: at a pose the weights are exactly one-hot
    legs, steps = poses - 1, frames - 1
    leg, step = np.divmod(np.arange(frames) * legs, steps)
    share = step / steps
    weights = np.zeros((frames, poses))
    rows = np.arange(frames)
    weights[rows, leg] = 1.0 - share
    inside = share > 0
    weights[rows[inside], leg[inside] + 1] = share[inside]
    return weights
