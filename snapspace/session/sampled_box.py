"""is_inside: whether a handle is inside the box of motions in which a model was sampled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..problem import euler_of_rotation

FloatArray = NDArray[np.float64]

_ROUNDING = 1e-9


def is_inside(bounds: FloatArray, offset: FloatArray) -> bool:
    """Whether the offset [A - I | t] (3, 4) of a handle is within its bounds (6,) of the box.

    An affine map that is not a rigid motion never is. A rotation has two triples of Euler angles
    (up to multiples of 2 pi); one of them in the box is enough.
    """
    bounds = bounds + _ROUNDING
    rotation = offset[:, :3] + np.eye(3)
    if not np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-9) or np.linalg.det(rotation) < 0:
        return False
    alpha, beta, gamma = euler_of_rotation(rotation)
    other = _wrapped(np.array([alpha + np.pi, np.pi - beta, gamma + np.pi]))
    within = (np.abs(np.stack([[alpha, beta, gamma], other])) <= bounds[3:]).all(axis=1)
    return bool((np.abs(offset[:, 3]) <= bounds[:3]).all() and within.any())


def _wrapped(angles: FloatArray) -> FloatArray:
    """The same angles in [-pi, pi)."""
    wrapped: FloatArray = (angles + np.pi) % (2.0 * np.pi) - np.pi
    return wrapped
