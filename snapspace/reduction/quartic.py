"""The elastic energy in reduced coordinates (paper, sec. 6.1)."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..arguments import as_coordinates, as_numbers, require_count
from ..energy import ElasticEnergy
from ..interruptible import run_abandonable
from ..problem import InterpolationProblem
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]


class Quartic:
    """E(tau + U q) as a polynomial of degree four in q, exact for St.Venant-Kirchhoff.

    Parameters
    ----------
    dimension : int, d
    coefficients : (C(d + 4, 4),)
        Coefficients of the monomials x_i x_j x_k x_l, i <= j <= k <= l, of x = (1, q); l slowest,
        i fastest. The polynomial on the first d' coordinates is therefore a prefix.

    Raises
    ------
    ValueError
        If the number of coefficients does not match.
    """

    def __init__(self, dimension: int, coefficients: FloatArray) -> None:
        dimension = require_count("Quartic", "dimension", dimension, at_least=0)
        coefficients = as_numbers("Quartic", "coefficients", coefficients)
        if coefficients.shape != (coefficient_count(dimension),):
            raise ValueError(
                f"Quartic: dimension {dimension} needs {coefficient_count(dimension)} "
                f"coefficients, got an array of shape {coefficients.shape}"
            )
        self.dimension = dimension
        self.coefficients = np.ascontiguousarray(coefficients, np.float64)

    def __reduce__(self) -> tuple[type[Quartic], tuple[int, FloatArray]]:
        """Pickles the definition; the compiled part is made again."""
        return type(self), (self.dimension, self.coefficients)

    @cached_property
    def _core(self) -> core.Quartic:
        """The compiled quartic, with a copy of the coefficients in the fastest order."""
        return core.Quartic(self.dimension, self.coefficients)

    def __repr__(self) -> str:
        return f"Quartic(dimension {self.dimension}, {len(self.coefficients)} coefficients)"

    def value(self, q: ArrayLike) -> float:
        """Energy at q (d,)."""
        return self.value_and_gradient(q)[0]

    def value_and_gradient(self, q: ArrayLike) -> tuple[float, FloatArray]:
        """Energy at q and its gradient (d,): U^T of the full gradient at tau + U q."""
        value, gradient = self._core.value_and_gradient(
            as_coordinates("Quartic", q, self.dimension)
        )
        return value, gradient

    def hessian(self, q: ArrayLike) -> FloatArray:
        """Hessian at q, (d, d)."""
        return self.derivatives(q)[2]

    def derivatives(self, q: ArrayLike) -> tuple[float, FloatArray, FloatArray]:
        """Energy at q, its gradient (d,) and Hessian (d, d), in one pass over the coefficients."""
        value, gradient, hessian = self._core.derivatives(
            as_coordinates("Quartic", q, self.dimension)
        )
        return value, gradient, hessian

    def leading(self, dimension: int) -> Quartic:
        """The polynomial on the first coordinates; ValueError unless there are that many."""
        dimension = require_count("Quartic", "dimension", dimension, at_least=0)
        return Quartic(dimension, self.coefficients[: coefficient_count(dimension)])


class PoseQuartics:
    """The exact energies of several poses, one quartic each: blends are their weighted sums.

    Parameters
    ----------
    dimension : int, d
    coefficients : (poses, C(d + 4, 4)), each row as in `Quartic`

    Raises
    ------
    ValueError
        If the number of coefficients does not match.
    """

    def __init__(self, dimension: int, coefficients: FloatArray) -> None:
        if coefficients.ndim != 2 or coefficients.shape[1] != coefficient_count(dimension):
            raise ValueError(
                f"PoseQuartics: dimension {dimension} needs {coefficient_count(dimension)} "
                f"coefficients per pose, got an array of shape {coefficients.shape}"
            )
        self.dimension = dimension
        self.coefficients = np.ascontiguousarray(coefficients, np.float64)

    def at(self, weights: ArrayLike) -> Quartic:
        """The blended energy for weights (poses,)."""
        w = as_numbers("InterpolationModel", "weights", weights)
        if w.shape != (len(self.coefficients),):
            raise ValueError(
                f"InterpolationModel: weights have shape {w.shape}, but must be "
                f"({len(self.coefficients)},), one per pose"
            )
        return Quartic(self.dimension, w @ self.coefficients)

    def leading(self, dimension: int) -> PoseQuartics:
        """The polynomials on the first coordinates."""
        return PoseQuartics(dimension, self.coefficients[:, : coefficient_count(dimension)])


def coefficient_count(dimension: int) -> int:
    """C(d + 4, 4), the number of monomials of degree up to four in d variables."""
    return math.comb(dimension + 4, 4)


def reduced_quartic(
    energy: ElasticEnergy, subspace: AffineSubspace, *, threads: int | None = None
) -> Quartic:
    """The elastic energy on a subspace.

    Cost: 6 m multiply-adds per pair of the (d + 1)(d + 2)/2 monomials of degree up to two, as one
    matrix product; the coefficients are bitwise the same for any number of threads (default: as
    many as the machine has).
    """
    coefficients = _coefficients(
        energy.core, energy.mesh.vertices.reshape(-1), subspace, threads=threads
    )
    return Quartic(subspace.dimension, coefficients)


def pose_quartics(
    problem: InterpolationProblem, subspace: AffineSubspace, *, threads: int | None = None
) -> PoseQuartics:
    """The elastic energies of all poses on a subspace, exact for St.Venant-Kirchhoff."""
    coefficients = [
        _coefficients(problem.pose_energy(k), pose, subspace, threads=threads)
        for k, pose in enumerate(problem.pose_shapes)
    ]
    return PoseQuartics(subspace.dimension, np.stack(coefficients))


def _coefficients(
    energy: core.ElasticEnergy, rest: FloatArray, subspace: AffineSubspace, *, threads: int | None
) -> FloatArray:
    modes = np.ascontiguousarray(np.vstack([subspace.tau - rest, subspace.basis.T]))
    coefficients: FloatArray = run_abandonable(
        lambda: core.quartic_coefficients(energy, modes, threads=threads or 0)
    )
    return coefficients
