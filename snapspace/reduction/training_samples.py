"""training_samples: the parameters and coordinates that a model records."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem, solutions_beyond_tau
from ..snapshots import Snapshots
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]


def training_samples(
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
