"""handle_windows: how much each vertex follows each handle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..problem import PosingProblem, require_posing_problem

FloatArray = NDArray[np.float64]

#: The motion whose response is measured, relative to the diagonal: so small that it is linear.
SMALL = 1e-4


def handle_windows(problem: PosingProblem) -> FloatArray:
    """How much each vertex follows each handle: smooth weights that add up to one.

    With them, `widen` takes snapshots apart: what one handle does to the body around it can
    be combined with what another one does elsewhere in another snapshot.

    Parameters
    ----------
    problem : PosingProblem

    Returns
    -------
    ndarray, (h, n)
        The mean, over the three axes, of a vertex's displacement along a small translation of a
        handle, as a share of it, in the linear response of the rest shape. It is nearly one on the
        handle, nearly zero on the others, and rarely outside of [0, 1] by more than 0.01. The first
        row is that of the fixed handle, what the others leave of one.

    Raises
    ------
    ValueError
        For something else than a PosingProblem.
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
