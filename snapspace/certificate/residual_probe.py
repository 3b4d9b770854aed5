"""ResidualProbe: the sampled residual of a frame, at a cost independent of the mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..problem import InterpolationProblem, PosingProblem

FloatArray = NDArray[np.float64]


class ResidualProbe:
    """The full objective's gradient at the vertices of a sample, for shapes of a subspace.

    The probe has everything that the gradient at these vertices depends on, so it is exact there,
    for every material. It takes about 1 ms on any mesh. The page has the same loops
    (core/online/residual_probe.h). `residual_probe` makes a probe.
    """

    _core: core.ResidualProbe

    def __init__(self, problem: PosingProblem | InterpolationProblem) -> None:
        self._state = "offsets" if isinstance(problem, PosingProblem) else "weights"

    def norm(self, q: FloatArray, state: FloatArray) -> float:
        """Estimate of sqrt(g^T D^-1 g), see `ResidualSample`, at tau + U q.

        Parameters
        ----------
        q : (d,)
            Reduced coordinates, or fewer leading ones.
        state : (h, 3, 4) or (k,)
            Offsets of the handles, or weights of the poses.
        """
        return self._core.norm(q, **{self._state: state})


def rest_shapes(problem: PosingProblem | InterpolationProblem) -> FloatArray:
    """The vertices at rest, or in all poses, registered to the mean shape: (1 or k, n, 3)."""
    if isinstance(problem, PosingProblem):
        return problem.mesh.vertices[None]
    return problem.pose_shapes.reshape(len(problem.poses), -1, 3)
