"""Predictions: a reduced model's solutions for samples that are not solved yet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..arguments import require_type
from ..interruptible import run_abandonable
from ..problem import Problem

FloatArray = NDArray[np.float64]

#: Curvatures are raised to at least this share of the largest: away from a minimum a reduced
#: Hessian may have negative ones, and a seed must be positive definite.
LEAST_CURVATURE = 1e-10


@dataclass(frozen=True, eq=False)
class Predictions:
    """Solutions of a reduced model for k samples, as starts of solves, and its Hessians there.

    With Hessians the seed of the fast solver is A^-1 + U B U^T, with the scalar factor's matrix A
    and the inverse Hessian B of each sample [two-level additive Schwarz: Dryja & Widlund 1990; a
    fixed inverse as the seed: Liu, Bouaziz, Kavan 2017]. A overestimates the stiffness of soft and
    smooth deformations; B has the right one. The term replaces the patches of blended surfaces,
    which have the same purpose. Newton's method has no seed.

    Parameters
    ----------
    displacements : (k, 3n)
        The solutions tau + U q, as displacements from the problem's base.
    basis : (3n, d), optional
        U, any independent deformations.
    inverses : (k, d, d), optional
        B, symmetric and positive definite.

    Raises
    ------
    ValueError
        For a basis without inverses or inverses without a basis, or if shapes do not match.
    """

    displacements: FloatArray
    basis: FloatArray | None = None
    inverses: FloatArray | None = None

    def __repr__(self) -> str:
        count, size = self.displacements.shape
        known = "" if self.basis is None else f", Hessians of dimension {self.basis.shape[1]}"
        return f"Predictions({count} samples, {size // 3} vertices{known})"

    def __post_init__(self) -> None:
        for name in ("displacements", "basis", "inverses"):
            kinds, cure = np.ndarray | None, "give an array"
            require_type("Predictions", name, getattr(self, name), kinds, cure)
        if np.ndim(self.displacements) != 2:
            raise ValueError(
                f"Predictions: displacements have shape {np.shape(self.displacements)}, but must "
                "be (k, 3n), one sample per row"
            )
        count, size = self.displacements.shape
        basis, inverses = self.basis, self.inverses
        if basis is None and inverses is None:
            return
        if basis is None or inverses is None:
            raise ValueError("Predictions: a basis needs inverses, and inverses need a basis")
        d = basis.shape[1]
        if len(basis) != size or inverses.shape != (count, d, d):
            raise ValueError(
                f"Predictions: {count} displacements of {size} numbers need a basis ({size}, d) "
                f"and inverses ({count}, d, d), got {basis.shape} and {inverses.shape}"
            )

    def with_inverses(self, inputs: FloatArray, which: slice) -> FloatArray:
        """Inputs of samples for the core, (j, m), each followed by B if any, (j, m + d^2)."""
        if self.inverses is None:
            return inputs
        inverses = self.inverses[which]
        return np.hstack([inputs, inverses.reshape(len(inverses), -1)])


def coarse_space(problem: Problem, basis: FloatArray | None) -> core.CoarseSpace | None:
    """The basis (3n, d) of predictions for the core's solves; None without predictions."""
    if basis is None:
        return None
    modes = np.ascontiguousarray(basis.T, np.float64)
    return run_abandonable(lambda: core.CoarseSpace(problem.system, modes))


def positive_inverse(hessian: FloatArray) -> FloatArray:
    """Inverse of |H|, with eigenvalues raised to a share of the largest [Nocedal & Wright, 3.4]."""
    values, vectors = np.linalg.eigh(hessian)
    sizes = np.abs(values)
    sizes = np.maximum(sizes, LEAST_CURVATURE * sizes.max())
    return np.ascontiguousarray((vectors / sizes) @ vectors.T)
