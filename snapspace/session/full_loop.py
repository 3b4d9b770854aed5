"""FullLoop: solves a reduced problem with the energy of the full mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import LinAlgError, cho_factor

from .. import _core as core
from ..blas import single_threaded_blas
from ..reduction import FullBlends, FullEnergy, InterpolationModel, PosingModel
from .kept_factor import KeptFactor

FloatArray = NDArray[np.float64]

#: Sufficient decrease, and how often a step is halved (Nocedal & Wright, 3.1).
DECREASE, HALVINGS = 1e-4, 30
#: Shift of a singular Hessian, relative to the mean of its diagonal; it grows by 16 until it
#: suffices.
FIRST_SHIFT, SHIFT_GROWTH, MOST_SHIFTS = 1e-10, 16.0, 20
#: Iterations of "bfgs" with one factor: about as many as its Hessian costs in gradients.
KEPT = 40
_NO_SINGLE = "Session: precision 'single' is for exact quartics; a full energy is in double"


@dataclass(frozen=True)
class FullReport:
    """How a solve ended; fields as for the core's reports."""

    status: core.Status
    iterations: int
    evaluations: int
    value: float
    gradient_norm: float


class FullLoop:
    """Minimises the energy of all tets and of the handles, from the last frame.

    Newton's method factors a Hessian in each iteration. "bfgs" keeps a factor for `KEPT`
    iterations, and corrects it by their steps. Where the Hessian is not positive definite, the sum
    of the tets' projected Hessians takes its place. The termination tests are those of the paper,
    sec. 6.2, as in the compiled loops.

    Parameters
    ----------
    energy : FullEnergy
    projection : projection of the tets' Hessians, as in the problem
    single : bool; ValueError if true, since all numbers are in double precision
    """

    def __init__(self, energy: FullEnergy, projection: str, *, single: bool) -> None:
        if single:
            raise ValueError(_NO_SINGLE)
        self._whole = self._energy = energy
        self._projection = getattr(core.Projection, projection)
        self._q = np.zeros(energy.dimension)

    @property
    def q(self) -> FloatArray:
        """Coordinates (d,) of the current shape."""
        return self._q.copy()

    @q.setter
    def q(self, q: ArrayLike) -> None:
        self._q = np.array(q, np.float64)

    @property
    def dimension(self) -> int:
        """Number of coordinates that are solved for."""
        return len(self._q)

    @dimension.setter
    def dimension(self, dimension: int) -> None:
        kept = self._q[:dimension]
        self._q = np.concatenate([kept, np.zeros(dimension - len(kept))])
        self._energy = self._whole.leading(dimension)

    def value_and_gradient(self, q: ArrayLike) -> tuple[float, FloatArray]:
        """Objective at q and its gradient (d,)."""
        at = np.asarray(q, np.float64)
        return self._with_handles(at, *self._energy.value_and_gradient(at))

    def hessian(self, q: ArrayLike) -> FloatArray:
        """Hessian of the objective at q, (d, d)."""
        return self._energy.hessian(q) + self._handle_hessian()

    def solve(
        self,
        *,
        method: core.Method,
        tolerance: float,
        max_iterations: int,
        max_evaluations: int,
        value_scale: float,
        coordinate_scale: float,
    ) -> FullReport:
        """Minimises from q, in place."""
        value, gradient = self.value_and_gradient(self._q)
        iterations, evaluations, status = 0, 1, core.Status.max_iterations
        if not np.isfinite(value):
            status, max_iterations = core.Status.not_finite, 0
        kept = 1 if method == core.Method.newton else KEPT
        inverse, age = None, 0
        while iterations < max_iterations:
            if evaluations >= max_evaluations:
                status = core.Status.max_evaluations
                break
            if inverse is None or age >= kept:
                inverse, age = self._inverse(), 0
            direction = inverse.direction(gradient)
            slope = float(gradient @ direction)
            size = np.linalg.norm(self._q) / coordinate_scale
            unit = 1.0 + abs(value) / value_scale
            if (
                -0.5 * slope / value_scale < tolerance * unit
                and np.linalg.norm(direction) / coordinate_scale < tolerance**0.5 * (1.0 + size)
                and np.linalg.norm(gradient) * coordinate_scale / value_scale
                < tolerance ** (1.0 / 3.0) * unit
            ):
                status = core.Status.converged
                break
            length, tried, after, new_gradient = self._step(direction, value, slope)
            evaluations += tried
            if length == 0.0 and age == 0:
                status = core.Status.line_search_failed
                break
            if length == 0.0:
                inverse = None
                continue
            self._q += length * direction
            inverse.learn(length * direction, new_gradient - gradient)
            value, gradient = after, new_gradient
            iterations, age = iterations + 1, age + 1
        return FullReport(status, iterations, evaluations, value, float(np.linalg.norm(gradient)))

    def _with_handles(
        self, q: FloatArray, value: float, gradient: FloatArray
    ) -> tuple[float, FloatArray]:
        return value, gradient

    def _handle_hessian(self) -> FloatArray | float:
        return 0.0

    @single_threaded_blas
    def _inverse(self) -> KeptFactor:
        """The inverse Hessian at q, or of projected tets if it is not positive definite."""
        hessian = self.hessian(self._q)
        try:
            return KeptFactor(cho_factor(hessian))
        except LinAlgError:
            projected = self._energy.hessian(self._q, projection=self._projection)
        hessian = projected + self._handle_hessian()
        shift = FIRST_SHIFT * float(np.trace(hessian)) / len(hessian)
        for _ in range(MOST_SHIFTS):
            try:
                return KeptFactor(cho_factor(hessian))
            except LinAlgError:
                hessian += shift * np.eye(len(hessian))
                shift *= SHIFT_GROWTH
        return KeptFactor((np.eye(len(hessian)), False))

    def _step(
        self, direction: FloatArray, value: float, slope: float
    ) -> tuple[float, int, float, FloatArray]:
        """Length of a step with sufficient decrease, or zero; number of evaluations; the end."""
        length = 1.0
        for tried in range(1, HALVINGS + 1):
            after, gradient = self.value_and_gradient(self._q + length * direction)
            if after <= value + DECREASE * length * slope:
                return length, tried, after, gradient
            length *= 0.5
        return 0.0, HALVINGS, value, np.zeros_like(direction)


class FullPosingLoop(FullLoop):
    """FullLoop of posing: set offsets, solve from the last frame."""

    def __init__(self, model: PosingModel, *, single: bool) -> None:
        assert isinstance(model.elastic, FullEnergy)
        super().__init__(model.elastic, model.problem.solving.projection, single=single)
        self._handles = model.handles
        self.set_offsets(np.zeros((len(model.problem.handles), 3, 4)))

    def set_offsets(self, offsets: FloatArray) -> None:
        """Offsets (h, 3, 4) of the handles."""
        self._offsets = np.array(offsets)

    def _with_handles(
        self, q: FloatArray, value: float, gradient: FloatArray
    ) -> tuple[float, FloatArray]:
        handles = self._handles.leading(len(q))
        flat = self._offsets.reshape(len(self._offsets), 12)
        pull = np.einsum("hik,hk->i", handles.L, flat)
        return value + handles.value(q, self._offsets), gradient + 2.0 * (handles.K @ q - pull)

    def _handle_hessian(self) -> FloatArray:
        d = self.dimension
        return 2.0 * self._handles.K[:d, :d]


class FullBlendingLoop(FullLoop):
    """FullLoop of blending: set weights, solve from the last frame."""

    def __init__(self, model: InterpolationModel, *, single: bool) -> None:
        assert isinstance(model.blends, FullBlends)
        self._blends = model.blends
        super().__init__(model.blends.energies, model.problem.solving.projection, single=single)

    def set_weights(self, weights: FloatArray) -> None:
        """Weights (poses,)."""
        self._whole = self._blends.at(weights)
        self._energy = self._whole.leading(self.dimension)
