"""The certain range of an as-rigid-as-possible surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .certain_range import CertainRange


def triangle_range(corners: NDArray[np.float64]) -> CertainRange:
    """Weights for which the blended energy of `ARAP` certainly has a minimum.

    The energy of a triangle is a multiple of tr(F M F^T), with M = sum_k w_k area_k A_k A_k^T,
    minus a term from the rotations, which grows only linearly; A_k maps the triangle in pose k to
    that in pose 0. If M is positive definite in all triangles the sum has a minimum. The condition
    is sufficient, not necessary: one compressed triangle ends the range.

    Parameters
    ----------
    corners : (poses, f, 3, 3)
        The triangles in every pose, none without area.
    """
    edges = corners[:, :, 1:] - corners[:, :, :1]
    metrics = edges @ edges.swapaxes(-1, -2)  # (poses, f, 2, 2)
    areas = np.sqrt(np.linalg.det(metrics))
    # area A A^T = area E_0 (E_k^T E_k)^-1 E_0^T up to the coordinates of pose 0, which all share
    forms = (areas / areas[0])[..., None, None] * np.linalg.inv(metrics)
    return CertainRange.of_forms(forms)
