"""CertainRange: weights for which a blended energy certainly has a minimum."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_numbers
from ..material import Material
from .simplex import Simplex

FloatArray = NDArray[np.float64]


class CertainRange:
    """Weights, even negative or above one, for which the blended energy certainly has a minimum.

    The blended energy of a collapsing density (stable neo-Hookean) is, in each tet,
    tr(F M F^T) / 2 + alpha/2 J^2 - beta J + const, and M and alpha are linear in the weights
    (docs/materials.md). If M is positive definite and alpha > 0 in all tets, the energy grows in
    every direction and therefore has a minimum. Such weights form a convex set that contains the
    whole simplex. The condition is sufficient, not necessary: one bad tet ends the range, while the
    sum over all tets may have a minimum farther out. The condition does not imply that the minimum
    is unique.

    Parameters
    ----------
    corners : (poses, tets, 4, 3) float64
        The tets in every pose, none without volume; an inverted one counts as its mirror image.

    Raises
    ------
    ValueError
        For another shape of the array, fewer than two poses or no tets, or a tet without volume
        or with a corner that is not finite.

    Notes
    -----
    With the edges E_k and volume v_k of a tet in pose k, and A_k = E_0 E_k^-1, M is
    mu sum_k w_k v_k A_k A_k^T and alpha is (lam + mu) v_0^2 sum_k w_k / v_k: moduli are common
    factors, so the range depends only on the poses.
    """

    def __init__(self, corners: ArrayLike) -> None:
        self._set(*_terms(_checked(corners)))

    @classmethod
    def of_forms(cls, forms: FloatArray) -> CertainRange:
        """The range in which weighted sums of quadratic forms are positive definite.

        For energies that differ from such a form by a term of slower growth, such as those of
        `ARAP`.

        Parameters
        ----------
        forms : (poses, m, s, s) float64
            m symmetric matrices of each pose, whose means over the poses are positive definite.
        """
        made = cls.__new__(cls)
        made._set(forms, np.ones(forms.shape[:2]))
        return made

    def _set(self, squares: FloatArray, alphas: FloatArray) -> None:
        # relative to equal weights, for which M is the identity and alpha is one
        factors = np.linalg.inv(np.linalg.cholesky(squares.mean(axis=0)))
        self._squares = factors @ squares @ factors.swapaxes(-1, -2)
        self._alphas = alphas / alphas.mean(axis=0)
        self._domain = Simplex(corners=len(squares))

    def __repr__(self) -> str:
        return f"CertainRange({self.poses} poses, {self._squares.shape[1]} forms each)"

    @property
    def poses(self) -> int:
        """Number of weights."""
        return self._domain.corners

    def margin(self, weights: ArrayLike) -> float:
        """The smallest of alpha and the eigenvalues of M over all tets, for weights (poses,).

        It is relative to equal weights: one there, zero on the boundary of the range, and negative
        beyond. It is concave in the weights.

        Raises
        ------
        ValueError
            As for `Simplex.check`, except that negative weights are accepted.
        """
        w = self._checked_weights(weights)
        size = max(np.abs(w).max(), 1.0)  # keeps sums of huge weights finite
        return float(size * self._least(w / size))

    def holds(self, weights: ArrayLike) -> bool:
        """Whether weights (poses,) are inside the range; False on its boundary.

        Raises ValueError as `margin`.
        """
        return self.margin(weights) > 0.0

    def reach(self, toward: ArrayLike, *, start: ArrayLike | None = None) -> float:
        """How far the line from some weights to others stays in the range.

        Parameters
        ----------
        toward : array_like, (poses,)
            Weights at the end of the line.
        start : array_like, (poses,), optional
            Weights at the start of the line. Default: equal weights.

        Returns
        -------
        float
            The largest t >= 0 with start + t (toward - start) in the closed range: above one if
            `toward` is in the range; infinite if the whole ray is; zero if the start is not.

        Raises
        ------
        ValueError
            As for `margin`, for either weights.
        """
        begin = self._domain.center if start is None else self._checked_weights(start)
        step = self._checked_weights(toward) - begin
        if not self.margin(begin) > 0.0:
            return 0.0
        length = float(np.abs(step).max())
        if length == 0.0:
            return np.inf
        # 1 + t e vanishes first for the smallest eigenvalue e of the step relative to the start
        factors = np.linalg.inv(np.linalg.cholesky(_sum(begin, self._squares)))
        moved = factors @ _sum(step / length, self._squares) @ factors.swapaxes(-1, -2)
        alphas = _sum(step / length, self._alphas) / _sum(begin, self._alphas)
        steepest = min(_least_eigenvalue(moved), float(alphas.min()))
        # smaller slopes are rounding, where nothing changes along the line
        return -1.0 / steepest / length if steepest < -1e-12 else np.inf

    def limits(self) -> FloatArray:
        """The smallest and the largest weight of each pose while the others share the rest equally.

        Returns
        -------
        ndarray, (poses, 2) float64
            The smallest is negative and the largest above one. They are infinite where the range
            does not end.
        """
        center, limits = self._domain.center, np.empty((self.poses, 2))
        for pose, alone in enumerate(np.eye(self.poses)):
            step = alone - center
            limits[pose] = (
                center[pose] - self.reach(center - step) * step[pose],
                center[pose] + self.reach(alone) * step[pose],
            )
        return limits

    def _least(self, weights: FloatArray) -> float:
        alphas = _sum(weights, self._alphas)
        return min(_least_eigenvalue(_sum(weights, self._squares)), float(alphas.min()))

    def _checked_weights(self, weights: ArrayLike) -> FloatArray:
        return self._domain.check(weights, extrapolate=True, who="CertainRange")


def certain_range(material: Material, corners: ArrayLike) -> CertainRange | None:
    """The range of a material's blends, or None if no test is known.

    Densities that do not collapse have no cheap test. Weights that are not negative are safe for
    all materials: the blend is a sum of energies that have minima.

    Parameters
    ----------
    material : Material
    corners : (poses, tets, 4, 3) float64
        As for `CertainRange`, which also lists the errors.
    """
    return CertainRange(corners) if material.collapses else None


def _checked(corners: ArrayLike) -> FloatArray:
    array = as_numbers("CertainRange", "corners", corners)
    if array.ndim != 4 or array.shape[2:] != (4, 3) or array.shape[0] < 2 or array.shape[1] < 1:
        raise ValueError(
            "CertainRange: corners must be (poses, tets, 4, 3) with two poses or more and a tet, "
            f"got {array.shape}"
        )
    if not np.isfinite(array).all():
        raise ValueError("CertainRange: a corner is not finite")
    return array


def _terms(corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """v A A^T (poses, tets, 3, 3) and 1 / v (poses, tets), in units of the volumes in pose 0."""
    edges = corners[:, :, 1:] - corners[:, :, :1]  # E^T
    volumes = np.abs(np.linalg.det(edges))
    if not (volumes > 0.0).all():
        pose, tet = np.argwhere(~(volumes > 0.0))[0]
        raise ValueError(f"CertainRange: tet {tet} of pose {pose} has no volume")
    volumes /= volumes[0]
    maps = np.linalg.solve(edges, np.broadcast_to(edges[0], edges.shape))  # A^T = E_k^-T E_0^T
    squares: FloatArray = volumes[..., None, None] * (maps.swapaxes(-1, -2) @ maps)
    return squares, 1.0 / volumes


def _sum(weights: FloatArray, terms: FloatArray) -> FloatArray:
    total: FloatArray = np.tensordot(weights, terms, axes=1)
    return total


def _least_eigenvalue(matrices: FloatArray) -> float:
    return float(np.linalg.eigvalsh(matrices)[:, 0].min())
