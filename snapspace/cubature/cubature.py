"""The elastic energy in reduced coordinates, summed over a few tets (cubature)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..energy import ShellMaterial
from ..material import Material
from ..problem import PosingProblem
from ..subspace import AffineSubspace
from .chosen_tets import check_chosen, check_in_mesh
from .elements import posed_elements_of
from .summed_curvatures import summed_curvatures

FloatArray = NDArray[np.float64]


class Cubature:
    """E(tau + U q) as a sum of the energies of a few tets with positive weights.

    After An, Kim, James 2008, "Optimizing cubature for efficient integration of subspace
    deformations". An evaluation costs 18 r d multiply-adds for r tets, whatever the material. Rows
    are rounded to 5e-7 of their entries; value, gradient and Hessian are consistent to full
    precision. The tets of a shell are its elements, triangles and hinges.

    Parameters
    ----------
    tets : (r,) int32
        Which tets of the mesh, or which elements of a shell, ascending.
    weights : (r,) float64
        The volume that each tet stands for, or the measure of an element, > 0.
    rows : (r, 9, d) float32
        Displacement gradients of the modes in these tets, see `displacement_gradients`.
    material : Material or ShellMaterial
        The density of these tets, with constant moduli or r values of each.
    remainder : (d, d), optional
        What is left of the energy, q^T K q, see `Elements`. Default: nothing.

    Raises
    ------
    ValueError
        If sizes do not match, including those of the moduli, or a weight is not positive and
        finite.
    """

    def __init__(
        self,
        tets: NDArray[np.int32],
        weights: FloatArray,
        rows: NDArray[np.float32],
        material: Material | ShellMaterial,
        remainder: FloatArray | None = None,
    ) -> None:
        check_chosen(tets, weights, rows, material, who="Cubature")
        self.tets = tets
        self.weights = weights
        self.rows = np.ascontiguousarray(rows, np.float32)
        self.material = material
        self.remainder = remainder
        self._core = core.Cubature(self.rows, self.weights, material.core)

    @classmethod
    def of_tets(
        cls,
        problem: PosingProblem,
        subspace: AffineSubspace,
        tets: NDArray[np.int32],
        weights: FloatArray,
        *,
        remainder: FloatArray | None = None,
    ) -> Cubature:
        """Makes the cubature of some tets for a subspace attached to the rest shape.

        With all tets, weighted by their volumes, it is the exact energy. What they leave of the
        energy, see `Elements`, is computed if it is not given.

        Raises
        ------
        ValueError
            As for the constructor, or for a tet that the mesh does not have.
        """
        elements = posed_elements_of(problem)
        check_in_mesh(tets, len(elements.measures), who="Cubature")
        rows = elements.gradients(subspace.basis, tets)
        if remainder is None:
            remainder = elements.remainder(subspace.basis)
        return cls(tets, weights, rows, elements.material.of_tets(tets), remainder)

    def __reduce__(self) -> tuple[type[Cubature], tuple[Any, ...]]:
        """Pickles the arguments; unpickling makes the compiled part again."""
        return type(self), (self.tets, self.weights, self.rows, self.material, self.remainder)

    @property
    def dimension(self) -> int:
        """d."""
        return int(self.rows.shape[2])

    def value(self, q: ArrayLike) -> float:
        """Energy at q (d,)."""
        return self.value_and_gradient(q)[0]

    def value_and_gradient(self, q: ArrayLike) -> tuple[float, FloatArray]:
        """Energy at q and its gradient (d,)."""
        at = np.asarray(q, np.float64)
        value, gradient = self._core.value_and_gradient(at)
        if self.remainder is not None:
            half = self.remainder @ at
            value, gradient = value + float(at @ half), gradient + 2.0 * half
        return value, gradient

    def hessian(self, q: ArrayLike) -> FloatArray:
        """Hessian at q, (d, d)."""
        return self._with_remainder(self._core.derivatives(np.asarray(q, np.float64))[2])

    def rough_hessian(self, q: ArrayLike) -> FloatArray:
        """The Hessian summed in single precision, which is faster: see `summed_curvatures`."""
        curvatures = self._core.curvatures(np.asarray(q, np.float64))
        return self._with_remainder(summed_curvatures(self.rows, curvatures))

    def leading(self, dimension: int) -> Cubature:
        """The cubature of the same tets for the first `dimension` coordinates."""
        remainder = self.remainder
        if remainder is not None:
            remainder = np.ascontiguousarray(remainder[:dimension, :dimension])
        rows = self.rows[:, :, :dimension]
        return Cubature(self.tets, self.weights, rows, self.material, remainder)

    def without_remainder(self) -> Cubature:
        """The sum over tets alone."""
        return Cubature(self.tets, self.weights, self.rows, self.material)

    def _with_remainder(self, hessian: FloatArray) -> FloatArray:
        return hessian if self.remainder is None else hessian + 2.0 * self.remainder
