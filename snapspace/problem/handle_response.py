"""HandleResponse: guesses near the solutions for moved handles, without solving."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from .. import _core as core
from ..interruptible import run_abandonable

if TYPE_CHECKING:
    from .posing_problem import PosingProblem

FloatArray = NDArray[np.float64]


class HandleResponse:
    """Linear responses of a problem's rest shape to small motions of its handles.

    Handles whose bounds are zero are assumed to be at rest.
    """

    def __init__(self, problem: PosingProblem) -> None:
        self._moving = 1 + np.flatnonzero(problem.domain.bounds.any(axis=1))
        directions = np.eye(3)
        asked = []
        for handle in self._moving:
            small = np.zeros((6, len(problem.handles), 3, 4))
            small[:3, handle, :, 3] = directions
            small[3:, handle, :, :3] = -np.cross(directions[:, None], directions)  # [axis] x
            asked.append(problem.target_displacements(small).reshape(6, -1))
        system, inputs = problem.system, np.concatenate(asked)
        self._response = run_abandonable(lambda: core.LinearResponse(system, inputs))

    # The problem is not an attribute: it owns this response, and a cycle would keep both in memory.
    def guesses(self, problem: PosingProblem, parameters: FloatArray) -> FloatArray:
        """Displacements near the solutions: the linear response, with finite rotations.

        Parameters
        ----------
        problem : PosingProblem
            The problem that this response was made for.
        parameters : (k, p)

        Returns
        -------
        ndarray, (k, 3n)
            In rotation-strain coordinates (Huang et al. 2011): in every tet, the gradient of the
            response to t and the logarithm of R is interpreted as the logarithm of a rotation plus
            a strain. Rotations and strains are then integrated. Up to the tolerance of the
            responses, the guess is exact if all handles have the same motion, and its error is
            quadratic for small motions.
        """
        offsets = problem.offsets_of_all(parameters)[:, self._moving]
        rotations = (offsets[..., :3] + np.eye(3)).reshape(-1, 3, 3)
        turns = Rotation.from_matrix(rotations).as_rotvec().reshape(*offsets.shape[:2], 3)
        motions = np.concatenate([offsets[..., 3], turns], axis=-1).reshape(len(offsets), -1)
        response, system, inputs = self._response, problem.system, problem.inputs(parameters)
        return run_abandonable(lambda: response.warped(system, motions, inputs))
