"""What every reduction needs: a check of the subspace, and the training data of its snapshots."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem, solutions_beyond_tau
from ..snapshots import Snapshots
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]


def check_attached(
    problem: PosingProblem | InterpolationProblem, subspace: AffineSubspace, *, who: str
) -> None:
    """ValueError of `who` unless the subspace goes through the problem's tau."""
    if subspace.tau.shape != problem.base.shape or not np.array_equal(subspace.tau, problem.tau):
        raise ValueError(
            f"{who}: the subspace is not attached to the problem's reference shape: the rest shape "
            "of posing, the mean shape of interpolation"
        )


def training(
    problem: PosingProblem | InterpolationProblem,
    subspace: AffineSubspace,
    snapshots: Snapshots | None,
) -> tuple[FloatArray, FloatArray]:
    """Parameters and coordinates of the snapshots, and of the solutions known without solving."""
    if snapshots is None:
        return np.zeros((0, problem.parameter_count)), np.zeros((0, subspace.dimension))
    known, shapes = solutions_beyond_tau(problem)
    parameters = np.vstack([snapshots.parameters, known])
    displacements = snapshots.displacements.followed_by(shapes - problem.base)
    offset = problem.base - problem.tau
    return parameters, subspace.row_coordinates(displacements.shifted(offset))
