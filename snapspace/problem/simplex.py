"""Simplex: the parameter domain of shape interpolation."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_arrays, is_finite, require_count, shown
from ..sampling import sobol_points
from .blends import blend_weights

FloatArray = NDArray[np.float64]

#: Largest distance of a sum of weights from one. In single precision, weights divided by their sum
#: miss it by 1e-7. Shapes do not change, since a common factor of the weights does not move a
#: minimum.
_SUM_TOLERANCE = 1e-6
#: How far a weight may be beyond a face of the domain.
_FACE_TOLERANCE = 1e-9


@dataclass(frozen=True, kw_only=True)
class Simplex:
    """Interpolation weights: none is negative and they sum to one (paper, sec. 4.1).

    Parameters
    ----------
    corners : int
        Number of weights, one per pose; two or more.
    extrapolation : float, default 0
        Enlarges the simplex by 1 + extrapolation about its centre: weights go down to
        -extrapolation / corners.

    Raises
    ------
    ValueError
        For fewer than two corners, or an extrapolation that is negative or not finite.

    Notes
    -----
    A parameter vector has one weight per corner, though the domain has one dimension less.
    """

    corners: int
    extrapolation: float = 0.0

    def __post_init__(self) -> None:
        if require_count("Simplex", "corners", self.corners) < 2:
            raise ValueError(
                f"Simplex: corners is {self.corners}, but weights need two poses or more"
            )
        if not (is_finite(self.extrapolation) and self.extrapolation >= 0):
            raise ValueError(
                f"Simplex: extrapolation is {shown(self.extrapolation)}, but it must be zero or "
                "positive"
            )

    @property
    def dimension(self) -> int:
        """Number of axes of the unit cube, one less than corners."""
        return self.corners - 1

    @property
    def free_axes(self) -> NDArray[np.bool_]:
        """Mask (dimension,) of the axes along which the domain has extent: all of them."""
        return np.ones(self.dimension, dtype=np.bool_)

    @property
    def center(self) -> FloatArray:
        """Equal weights, (corners,)."""
        return np.full(self.corners, 1.0 / self.corners)

    @property
    def lowest(self) -> float:
        """The smallest weight of the domain, -extrapolation / corners."""
        return -self.extrapolation / self.corners if self.extrapolation else 0.0

    def from_unit(self, points: FloatArray) -> FloatArray:
        """Maps points of the unit cube, (k, dimension) in [0, 1], onto weights, (k, corners).

        One to one up to the cube's boundary, and uniform points become uniform weights. With c
        corners the first weight is distributed as Beta(1, c - 1), the next one as Beta(1, c - 2)
        in what the first has left, and so on (stick-breaking: Devroye 1986, Non-Uniform Random
        Variate Generation); each is the inverse distribution function of its coordinate. Rows sum
        to one up to rounding.
        """
        points = np.atleast_2d(as_arrays("Simplex", "points", points, self.dimension))
        kept = (1.0 - points) ** (1.0 / np.arange(self.dimension, 0, -1))
        left = np.cumprod(kept, axis=1)
        before = np.concatenate([np.ones((len(points), 1)), left[:, :-1]], axis=1)
        # the last weight is what is left, and not 1 - sum, which rounding can make negative
        return self._enlarged(np.concatenate([before * (1.0 - kept), left[:, -1:]], axis=1))

    def grid(self, count: int) -> FloatArray:
        """Centres of equal cells, (k, corners), symmetric in the corners.

        The cells are the simplex scaled by 1 / (N + 1), at the places where all weights of their
        lowest corners are whole multiples i of 1 / (N + 1): weights (i + 1 / corners) / (N + 1)
        with integers i >= 0 that sum to N. N is the largest number with
        k = C(N + corners - 1, corners - 1) <= count (at least 1). Ordered by the first weight,
        then by the second, and so on, each increasing.
        """
        require_count("Simplex", "count", count)
        level = 0
        while math.comb(level + self.corners, self.dimension) <= count:
            level += 1
        # stars and bars: the gaps between `dimension` bars among level + dimension places
        places = range(level + self.dimension)
        bars = np.array(list(combinations(places, self.dimension)), dtype=np.int64)
        steps = np.diff(bars, axis=1, prepend=-1, append=level + self.dimension) - 1
        return self._enlarged((steps + 1.0 / self.corners) / (level + 1))

    def blends(self, count: int, *, seed: int = 0, scramble: bool = True) -> FloatArray:
        """Weights (count, corners): blends of two corners first, then of three and of all as well.

        These are for many corners, where uniform points lie around the centre and say little about
        blends of few. All pairs are blended evenly before any pair is blended again, see
        `blend_weights`. A sample does not depend on the number of samples. With extrapolation the
        weights of two or three corners reach down to `lowest` while the others are zero, and blends
        of all corners fill the whole domain. Corners themselves are left out, because their
        solutions are known.

        Parameters
        ----------
        count : int
            Number of samples, > 0.
        seed : int, default 0
            Seeds the order of the corners, and the Sobol sequence of the blends of all corners.
        scramble : bool, default True
            If False, corners come in their own order, and the Sobol sequence is not scrambled.
        """
        require_count("Simplex", "count", count, at_least=1)
        require_count("Simplex", "seed", seed, at_least=0)
        inside = self.from_unit(sobol_points(self.dimension, count, seed=seed, scramble=scramble))
        order = np.arange(self.corners)
        if scramble:
            # a separate stream: the first numbers of the other one scramble the Sobol sequence
            order = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(2,))).permutation(
                self.corners
            )
        return blend_weights(inside, lowest=self.lowest, order=order)

    def scaled(self, parameters: FloatArray) -> FloatArray:
        """Coordinates in which distances of parameters are comparable: the weights themselves."""
        return parameters

    def contains(self, weights: ArrayLike) -> bool:
        """Whether these are weights of the domain, as `check` decides."""
        try:
            self.check(weights)
        except ValueError:
            return False
        return True

    def check(
        self, weights: ArrayLike, *, extrapolate: bool = False, who: str = "Simplex"
    ) -> FloatArray:
        """The given weights as an array, after checks.

        Parameters
        ----------
        weights : array_like, (corners,)
        extrapolate : bool, default False
            Accepts any weights that sum to one, however negative.
        who : str
            The start of the error message.

        Returns
        -------
        ndarray, (corners,) float64
            The unchanged weights. Their sum may differ from one by 1e-6, and they may lie beyond a
            face of the domain by 1e-9.

        Raises
        ------
        ValueError
            For a wrong number of weights, a weight that is not finite, a sum that is not one, or
            a weight outside the domain.
        """
        try:
            w = np.array(weights, np.float64)
        except (TypeError, ValueError):
            raise ValueError(
                f"{who}: weights must be {self.corners} numbers, one per pose"
            ) from None
        if w.shape != (self.corners,):
            raise ValueError(
                f"{who}: {self.corners} poses need {self.corners} weights, got "
                f"{w.size if w.ndim == 1 else w.shape}"
            )
        if not np.isfinite(w).all():
            bad = np.flatnonzero(~np.isfinite(w))[0]
            raise ValueError(f"{who}: weight {bad} is {w[bad]}, but it must be finite")
        with np.errstate(over="ignore"):
            total = float(w.sum())
        if not abs(total - 1.0) <= _SUM_TOLERANCE:
            raise ValueError(
                f"{who}: the weights sum to {total:.10g}, but they must sum to 1; "
                "divide them by their sum"
            )
        outside = np.flatnonzero(w < self.lowest - _FACE_TOLERANCE)
        if outside.size and not extrapolate:
            raise ValueError(
                f"{who}: weight {outside[0]} is {w[outside[0]]:g}, but none may be below "
                f"{self.lowest:g}; InterpolationProblem(extrapolation=...) enlarges the domain, "
                "and blend(extrapolate=True) leaves it"
            )
        return w

    def _enlarged(self, weights: FloatArray) -> FloatArray:
        """Maps weights of the simplex onto the domain, which is enlarged about the centre."""
        return (1.0 + self.extrapolation) * weights + self.lowest
