"""The elastic energy in reduced coordinates, summed over few tets (cubature)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..material import Material
from ..problem import PosingProblem
from ..subspace import AffineSubspace
from .displacement_gradients import displacement_gradients

FloatArray = NDArray[np.float64]


class Cubature:
    """E(tau + U q) as a sum of the energies of a few tets with positive weights.

    After An, Kim, James 2008, "Optimizing cubature for efficient integration of subspace
    deformations". An evaluation costs 18 r d multiply-adds for r tets, whatever the material. Rows
    are rounded to 5e-7 of their entries; value, gradient and Hessian belong together to full
    precision.

    Parameters
    ----------
    tets : (r,) int32
        Which tets of the mesh, ascending.
    weights : (r,) float64
        The volume that each stands for, > 0.
    rows : (r, 9, d) float32
        Displacement gradients of the modes in these tets, see `displacement_gradients`.
    material : Material
        The density of these tets, with the same moduli in all of them or r of each.

    Raises
    ------
    ValueError
        If the sizes do not match, those of the moduli included, or a weight is not positive and
        finite.
    """

    def __init__(
        self,
        tets: NDArray[np.int32],
        weights: FloatArray,
        rows: NDArray[np.float32],
        material: Material,
    ) -> None:
        r = len(tets)
        if r == 0 or weights.shape != (r,) or rows.ndim != 3 or rows.shape[:2] != (r, 9):
            raise ValueError(
                f"Cubature: {r} tets need weights ({r},) and rows ({r}, 9, d), got arrays of "
                f"shapes {weights.shape} and {rows.shape}"
            )
        bad = np.flatnonzero(~(np.isfinite(weights) & (weights > 0)))
        if bad.size:
            raise ValueError(
                f"Cubature: the weight of tet {tets[bad[0]]} is {weights[bad[0]]}, but weights "
                "must be positive"
            )
        material.check_tets(r, "Cubature")
        self.tets = tets
        self.weights = weights
        self.rows = np.ascontiguousarray(rows, np.float32)
        self.material = material
        self._core = core.Cubature(self.rows, self.weights, material.core)

    @classmethod
    def of_tets(
        cls,
        problem: PosingProblem,
        subspace: AffineSubspace,
        tets: NDArray[np.int32],
        weights: FloatArray,
    ) -> Cubature:
        """The cubature of some tets on a subspace attached to the rest shape.

        With all tets, weighted by their volumes, it is the exact energy.

        Raises
        ------
        ValueError
            As for the constructor, or for a tet that the mesh does not have.
        """
        count = len(problem.mesh.tets)
        if len(tets) and not 0 <= tets.min() <= tets.max() < count:
            raise ValueError(f"Cubature: tets must be between 0 and {count - 1}")
        rows = displacement_gradients(problem.mesh, subspace.basis, tets)
        return cls(tets, weights, rows, problem.material.of_tets(tets))

    @property
    def dimension(self) -> int:
        """d."""
        return int(self.rows.shape[2])

    def value(self, q: ArrayLike) -> float:
        """Energy at q (d,)."""
        return self.value_and_gradient(q)[0]

    def value_and_gradient(self, q: ArrayLike) -> tuple[float, FloatArray]:
        """Energy at q and its gradient (d,)."""
        value, gradient = self._core.value_and_gradient(np.asarray(q, np.float64))
        return value, gradient

    def hessian(self, q: ArrayLike) -> FloatArray:
        """Hessian at q, (d, d)."""
        hessian: FloatArray = self._core.derivatives(np.asarray(q, np.float64))[2]
        return hessian

    def leading(self, dimension: int) -> Cubature:
        """The same tets on the first coordinates."""
        return Cubature(self.tets, self.weights, self.rows[:, :, :dimension], self.material)
