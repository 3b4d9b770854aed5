"""RestrictedEnergy: the full mesh's objective on a subspace, and its minimisers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from ..problem import Problem
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]

#: Largest number of shapes that are evaluated together, so that memory does not grow with d.
TOGETHER = 16
#: Step of finite differences relative to the coordinates' scale, as for the Hessian at the mean
#: shape.
STEP = 1e-4
#: The descent ends when twice the predicted decrease is below this share of the energy's scale. Its
#: square root, 1e-6, is far below the errors of any model.
TOLERANCE = 1e-12
#: Blends without handles have soft directions: those of the helix at d = 70 take hundreds of steps.
MOST_STEPS = 2000
#: Curvatures are raised to at least this share of the largest.
LEAST_CURVATURE = 1e-10
#: Sufficient decrease, and the largest number of halvings of a step (Nocedal & Wright, 3.1).
DECREASE, HALVINGS = 1e-4, 30


class RestrictedEnergy:
    """F(tau + U q, w) of all tets for one parameter vector, as a function of q.

    A gradient is U^T g with one gradient g of the full problem. The energy equals that of a
    cubature with all tets, weighted by their volumes, but does not need 36 bytes per tet and mode.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    subspace : AffineSubspace
    parameters : (p,)
    threads : number of threads, default None for all
    """

    def __init__(
        self,
        problem: Problem,
        subspace: AffineSubspace,
        parameters: FloatArray,
        *,
        threads: int | None = None,
    ) -> None:
        self._system = problem.system
        self._basis = subspace.basis
        self._origin = subspace.tau - problem.base
        self._inputs = problem.inputs(parameters[None])
        self._threads = threads or 0

    @single_threaded_blas
    def evaluated(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Values (k,) and gradients (k, d) at coordinates (k, d)."""
        values, gradients = np.empty(len(points)), np.empty(points.shape)
        for begin in range(0, len(points), TOGETHER):
            piece = slice(begin, begin + TOGETHER)
            shapes = np.ascontiguousarray(self._origin + points[piece] @ self._basis.T)
            inputs = np.repeat(self._inputs, len(shapes), axis=0)
            found = self._system.evaluate(shapes, inputs, threads=self._threads)
            values[piece], gradients[piece] = found[0], found[1] @ self._basis
        return values, gradients

    def hessian(self, q: FloatArray, step: float) -> FloatArray:
        """Hessian (d, d) at q by central differences of gradients: 2 d evaluations."""
        offsets = step * np.eye(len(q))
        after, before = (self.evaluated(q + sign * offsets)[1] for sign in (1.0, -1.0))
        matrix = (after - before) / (2.0 * step)
        symmetric: FloatArray = (matrix + matrix.T) / 2.0
        return symmetric

    @single_threaded_blas
    def minimiser(self, start: FloatArray, *, value_scale: float, scale: float) -> FloatArray:
        """The minimiser (d,) where a descent from `start` (d,) ends.

        BFGS with the inverse Hessian at the start (Nocedal & Wright, 6.1), and backtracking.

        Parameters
        ----------
        start : (d,)
        value_scale, scale : the model's scales of the energy and of the coordinates

        Raises
        ------
        ValueError
            If it does not converge.
        """
        q = start.copy()
        inverse = _positive_inverse(self.hessian(q, 1e-3 * STEP * scale))
        value, gradient = self._value_and_gradient(q)
        for _ in range(MOST_STEPS):
            direction = -inverse @ gradient
            slope = float(gradient @ direction)
            if -slope <= TOLERANCE * (value_scale + abs(value)):
                return q
            length, after, new_gradient = self._step(q, direction, value, slope)
            if length == 0.0:
                return q  # rounding hides any further decrease
            move, change = length * direction, new_gradient - gradient
            q, value, gradient = q + move, after, new_gradient
            inverse = _updated(inverse, move, change)
        raise ValueError(
            f"split_errors: the reduced minimiser of all tets was not found in {MOST_STEPS} steps; "
            "leave out this reference sample, or choose a smaller domain"
        )

    def _value_and_gradient(self, q: FloatArray) -> tuple[float, FloatArray]:
        values, gradients = self.evaluated(q[None])
        return float(values[0]), gradients[0]

    def _step(
        self, q: FloatArray, direction: FloatArray, value: float, slope: float
    ) -> tuple[float, float, FloatArray]:
        """Length of a step with sufficient decrease, zero if there is none; value and gradient."""
        length = 1.0
        for _ in range(HALVINGS):
            after, gradient = self._value_and_gradient(q + length * direction)
            if after <= value + DECREASE * length * slope:
                return length, after, gradient
            length *= 0.5
        return 0.0, value, np.zeros_like(q)


def _updated(inverse: FloatArray, move: FloatArray, change: FloatArray) -> FloatArray:
    """The BFGS update of an inverse Hessian; no update without enough curvature."""
    curvature = float(move @ change)
    if curvature <= 1e-12 * float(np.linalg.norm(move) * np.linalg.norm(change)):
        return inverse
    along = inverse @ change
    crossed = np.outer(along, move) / curvature
    factor = (1.0 + float(change @ along) / curvature) / curvature
    updated: FloatArray = inverse - crossed - crossed.T + factor * np.outer(move, move)
    return updated


def _positive_inverse(hessian: FloatArray) -> FloatArray:
    """Inverse of |H|, with eigenvalues raised to a share of the largest (Nocedal & Wright, 3.4)."""
    values, vectors = np.linalg.eigh(hessian)
    sizes = np.maximum(np.abs(values), LEAST_CURVATURE * np.abs(values).max())
    return np.asarray((vectors / sizes) @ vectors.T, np.float64)
