"""handle_windows: smooth weights that measure how much each vertex follows each handle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..problem import PosingProblem, require_posing_problem

FloatArray = NDArray[np.float64]

#: Length of the translations, relative to the diagonal: so small that the response is linear.
SMALL = 1e-4


def handle_windows(problem: PosingProblem) -> FloatArray:
    """How much each vertex follows each handle: smooth weights that add up to one.

    With them, `widen` splits snapshots: the deformation near one handle can be combined with the
    deformation near another one in another snapshot.

    Parameters
    ----------
    problem : PosingProblem

    Returns
    -------
    ndarray, (h, n)
        One row per handle: the displacement of each vertex along a small translation of the handle,
        as a share of that translation, averaged over the three axes. Displacements are the linear
        response of the rest shape. A weight is nearly one on its handle, nearly zero on the others,
        and rarely outside [0, 1] by more than 0.01. The first row belongs to the fixed handle: one
        minus the sum of the other rows.

    Raises
    ------
    ValueError
        For something other than a PosingProblem.
    """
    require_posing_problem(problem, "handle_windows")
    moving = len(problem.handles) - 1
    length = SMALL * problem.mesh.diagonal
    motions = np.zeros((moving, 3, moving, 6))
    handle, axis = np.arange(moving)[:, None], np.arange(3)
    motions[handle, axis, handle, axis] = length
    moved = problem.guesses(motions.reshape(3 * moving, -1))
    along = np.einsum("hava->hv", moved.reshape(moving, 3, -1, 3)) / (3 * length)
    windows: FloatArray = np.vstack([1.0 - along.sum(axis=0), along])
    return windows
